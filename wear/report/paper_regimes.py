"""The paper's sections on validity and regimes: what a slope means for the long run."""

from __future__ import annotations

import sympy as sp

from derive.results.regime_map import OPEN, REGIMES
from derive.results.validity import RESOLUTIONS
from derive.typeset.display import inline
from derive.typeset.present import presentable
from wear.generated import asymptotics as formula
from wear.report import figures_of_note
from wear.report.document import Column, Math, Number, Reference, Section, Table, Text
from wear.report.material import Material, count, drawn, mm
from wear.report.moves import listed
from wear.report.paper_equations import label
from wear.report.runs import known
from wear.report.words import paragraph, words


def validity(material: Material) -> Section:
    """What the printed bound of f_c means."""
    eighth = float(formula.share_tanh(8.0))
    return Section(
        "sec:validity",
        "What a slope of one eighth means",
        (
            paragraph(
                "The note calls [eq:22] valid where $\\tanh(4-2/f_c)>-1$ and reads this as "
                "$f_c>1/8$. The inequality holds for every real argument; it excludes nothing:"
            ),
            *material.show("criterion", "share", "share-slope"),
            paragraph(
                "The asymptotic pressure increases with $f_c$, so that a demand on $f_c$ is a "
                "demand on how small a pressure may be before it is called zero. One eighth "
                "stands for $p_\\infty/p_{\\max}$ above {eighth}, the resolution of a calculation "
                "with some ten digits ([tab:thresholds]), not for a property of the model:",
                eighth=Number(eighth, 4, source="1/(1 + e^24)"),
            ),
            *material.show("threshold", "one-eighth"),
            _thresholds(),
            paragraph(
                "Without the cutoff the exact condition is $f_c>0$. With it, the closure ratio "
                "$1/f_c$ must lie within contact, $f_c\\ge 1/3$: below, wear stops "
                "([sec:regimes]). Of the note's examples, that of [fig:2a] has a slope of {first} "
                "and fails both conditions, and the note's own; that of [fig:3b], {last}, meets "
                "the first alone; that of [fig:3a], {middle}, meets the first and the note's own, "
                "but not that with the cutoff ([claim:C40]).",
                middle=Number(_slope(material, "section4"), 2, source="scene section4"),
                first=Number(_slope(material, "section3"), 1, source="scene section3"),
                last=Number(_slope(material, "section5"), 1, source="scene section5"),
            ),
        ),
    )


def _slope(material: Material, name: str) -> float:
    return material.runs.cases[name].scene.bearing.roughness_growth


def _thresholds() -> Table:
    rows = tuple(
        (
            (Text(name),),
            (Number(float(resolution), 4, source="resolution of the arithmetic"),),
            (
                Number(
                    float(formula.slope_threshold(epsilon=float(resolution))), 8, source="threshold"
                ),
            ),
        )
        for name, resolution in RESOLUTIONS.items()
    )
    columns = (
        Column(words("Arithmetic")),
        Column(words("$\\varepsilon$"), numeric=True),
        Column(words("Least $f_c$"), numeric=True),
    )
    caption = words(
        "The least $f_c$ for which $1+\\tanh(4-2/f_c)$ does not round to zero, by [eq:threshold]; "
        "sums below $2\\varepsilon$ do. The generated code does not form "
        "this sum and has no such threshold."
    )
    return Table("tab:thresholds", caption, columns, rows)


def _hypothesis(relation: sp.Basic) -> Math:
    """A hypothesis of the map, with the gap at the vanishing roughness by its name."""
    gap = sp.Symbol("h_star", real=True)  # of either sign here
    named = relation.xreplace({OPEN.relation.lhs: gap})
    return Math(inline(presentable(named)))


def _map() -> Table:
    """The rows of the map that the software decides by."""
    rows = tuple(
        (
            (Text("with" if regime.cutoff else "without"),),
            tuple(listed([(_hypothesis(c.relation),) for c in regime.conditions])),
            (Text(regime.name),),
            tuple(listed([(Reference(label(name), bare=True),) for name in regime.equations])),
        )
        for regime in REGIMES
    )
    columns = (
        Column(words("Cutoff")),
        Column(words("Where"), width=0.4),
        Column(words("Regime")),
        Column(words("Equations"), width=0.25),
    )
    caption = words(
        "The map of regimes of one worn solid; it covers all data with $\\sigma_c^0>0$, each once. "
        "The gap at the peak of the load where the roughness would vanish is "
        "$h^*=h_0-\\sigma_c^0/f_c-\\max U_a$. *Finite-time*: the roughness vanishes, and the model "
        "ends."
    )
    return Table("tab:regimes", caption, columns, rows)


def regimes(material: Material) -> Section:
    """All slopes, with and without the cutoff."""
    stop = material.runs.fate("section4.cutoff")
    return Section(
        "sec:regimes",
        "Map of regimes",
        (
            paragraph(
                "What becomes of the wear depends on $f_c$, and with the cutoff on $1/3$ in the "
                "place of zero ([fig:regimes], [tab:regimes])."
            ),
            _map(),
            drawn(
                "fig:regimes",
                figures_of_note.regimes(),
                paragraph(
                    "Asymptotic pressure of one worn solid over the roughness slope. The note's "
                    "bound $f_c=1/8$ lies inside the regime of steady wear and parts nothing "
                    "([tab:thresholds]). With the cutoff, wear goes on for ever only from "
                    "$f_c=1/3$ on."
                ),
                "A curve of pressure on a logarithmic axis that falls steeply as the slope "
                "decreases towards zero; three shaded ranges name the regimes.",
                "regimes",
            ),
            paragraph(
                "*Without the cutoff* wear is steady for $f_c>0$ ([sec:sound-route]). For any "
                "slope the rate stays below an exponential tail, which it approaches as "
                "$h/\\bar\\sigma$ grows:"
            ),
            *material.show("tail"),
            paragraph(
                "For $f_c=0$ that ratio grows for ever. Wear along the tail grows like the "
                "logarithm of the cycles; under a sine load it is [eq:logarithmic-wear], which "
                "bounds the wear from above. $I_0$ is a modified Bessel function, and "
                "$M=K_cVTp_{\\max}/(3H_c)$ the wear of a cycle under the largest pressure."
            ),
            *material.show("logarithmic-wear"),
            paragraph(
                "For $f_c<0$ the roughness would vanish at the wear $\\sigma_c^0/|f_c|$. There the "
                "gap at the peak of the load is $h^*=h_0-\\sigma_c^0/f_c-\\max U_a$. If it is "
                "open, $h^*>0$, the ratio $h/\\bar\\sigma$ grows without bound as the roughness "
                "falls, and the wear saturates at that depth, logarithmically slowly: under a "
                "constant load [eq:saturating-wear] has the cycles that it takes to a small "
                "roughness, in the sense that the quotient of the two sides' exponentials tends to "
                "one. If it is closed, $h^*<0$, part of every period has a rate above the bound "
                "[(eq:closed-gap)], and the roughness vanishes in finite time; there the model "
                "ends."
            ),
            *material.show("saturating-wear", "closed-gap"),
            paragraph(
                "*With the cutoff*, contact at a given wear is a condition on the load, and the "
                "margin $3\\bar\\sigma-h$ is linear in the wear."
            ),
            *material.show("contact-condition", "margin", "margin-rate"),
            paragraph(
                "For $f_c<1/3$ the gap outgrows the roughness. Beyond a depth that is known in "
                "closed form not even the peak of the load makes contact, and wear *arrests* (for "
                "$f_c<0$ if $h^*>0$; else the roughness vanishes first)."
            ),
            *material.show("arrest-depth", "no-contact", "rate-in-contact", "sliding-rate"),
            paragraph(
                "It does so in finite time if the load has a smooth peak. In contact the rate is "
                "never below [eq:rate-in-contact]; as long as the wear is short of the arrest "
                "depth by some amount, contact lasts a fixed part of every period, so that every "
                "cycle adds a fixed amount. Near the peak the load hardly rises: there wear in "
                "contact would use up the margin faster than the load restores it "
                "([eq:margin-rate]). Neither state can last then, and the solids slide along "
                "$h=3\\bar\\sigma$ in Filippov's sense [ref:filippov1988], wear following the "
                "load [(eq:sliding-rate)] up to the peak, where it has the arrest depth. With the "
                "data of the note's application this is {depth}, reached in cycle {cycle}.",
                depth=mm(known(stop.arrest_wear_mm), 4, "arrest depth, section 4 with cutoff"),
                cycle=count(known(stop.arrest_cycle), "section 4 with cutoff"),
            ),
            paragraph(
                "At $f_c=1/3$ the margin does not depend on the wear, and contact lasts the same "
                "part $d$ of every period. Above, contact is permanent from a certain wear on, and "
                "[eq:21] holds again."
            ),
            *material.show("one-third", "permanent-contact", "always-contact"),
            paragraph(
                "For two worn solids ([sec:two-solids] has $q$, $g$ and $p_1$) the margin is "
                "convex in the wear, which [eq:margin-curvature] calls $u_{\\mathrm{stop}}$ "
                "throughout, so that contact is lost at its first zero, the root of a quadratic "
                "equation. On a compliant support the pressure does not jump: where the smooth law "
                "would have $h>3\\bar\\sigma$, the bearing rests at $h=3\\bar\\sigma$ with the "
                "pressure that its springs give, and wear approaches the same depth without "
                "reaching it."
            ),
            *material.show("margin-curvature", "arrest-depth-two-solids", "edge-of-contact"),
        ),
    )
