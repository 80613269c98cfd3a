"""Generated NumPy modules: true to the derivation, accurate to roundoff, always the same."""

import random
from dataclasses import replace

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy.core.function import AppliedUndef

import wear.pressure_root
from derive import generate
from derive.codegen.sources import source
from derive.faults import UsageError
from derive.laws import LAWS, ContactLaw, r
from derive.note.condensed import CondensedProblem
from derive.note.governing import Pin
from derive.program import margin_program
from derive.program.gradient import by_constant
from derive.program.root import tail
from derive.program.symbols import pin_wear_sign
from derive.rules.algebra import substitute
from derive.symbols import QUANTITIES
from derive.variant import VARIANTS, Variant
from derive.zero import is_zero
from tests.derive import exact

COMPLIANT = [variant for variant in VARIANTS if variant.compliant]


def name_of(variant: Variant) -> str:
    return f"{variant.law.name}/{variant.name}"


every_variant = pytest.mark.parametrize("variant", VARIANTS, ids=map(name_of, VARIANTS))


def plain(expr: sp.Expr) -> sp.Expr:
    """Functions of time as the symbols of a program, the slip rate in terms of its data."""
    names = {"u_c": "u", "U_a": "U_a", "p": "p"}
    fields = [f for f in expr.atoms(AppliedUndef) if f.func.__name__ in QUANTITIES]
    return expr.xreplace({f: sp.Symbol(names[f.func.__name__], real=True) for f in fields})


def in_parameters(variant: Variant, name: str) -> sp.Expr:
    """The exact form of a generated function in terms of physical parameters."""
    made = exact.made(variant)
    function = next(f for f in made.functions if f.name == name)
    return exact.composed(function)[0].xreplace(exact.exact_constants(made))


def signed(variant: Variant, name: str):
    """The model and the exact form of a generated function, for both signs of pin wear."""
    found = in_parameters(variant, name)
    for opening in (False, True) if variant.pin.wears else (False,):
        sign = 1 if opening else -1
        yield CondensedProblem(variant.law, opening, variant.pin), found.subs(pin_wear_sign, sign)


# What the code computes


@pytest.mark.parametrize(
    ("phi", "inflection", "told"),
    [
        (
            1 / (1 + sp.exp(-2 * r)),
            sp.Integer(0),
            ["is not proved to be negative", "concave to convex at 0"],
        ),
        (-sp.exp(r), -sp.oo, ["-exp(r) is not proved to be positive", "concave to convex at -oo"]),
        (
            1 / (1 + sp.exp(2 * r - 4)),
            sp.Integer(1),
            ["phi does not turn from concave to convex at 1"],
        ),
        (1 / (1 + sp.exp(2 * r - 4)), -sp.oo, ["concave to convex at -oo"]),
        (1 / (1 + sp.exp(2 * r - 4)), sp.Integer(2), []),
        ((1 - r / sp.sqrt(1 + r**2)) / 2, sp.Integer(0), []),
    ],
)
def test_a_law_is_refused_unless_it_is_proved(phi, inflection, told):
    faults = generate.faults_of(ContactLaw("own", phi, inflection, "a test"))
    assert "\n".join(faults).count("own: ") == len(told)
    assert all(words in "\n".join(faults) for words in told)


def test_no_code_is_written_for_a_law_that_is_refused(monkeypatch, tmp_path):
    rising = ContactLaw("rising", 1 / (1 + sp.exp(-r)), sp.Integer(0), "a test")
    monkeypatch.setattr(generate, "LAWS", {**LAWS, "rising": rising})
    generate.sources.cache_clear()
    with pytest.raises(UsageError, match="rising: "):
        generate.write(tmp_path)
    assert list(tmp_path.iterdir()) == []
    monkeypatch.undo()
    generate.sources.cache_clear()


def test_outdated_tells_missing_changed_and_strange_files(tmp_path):
    assert set(generate.outdated(tmp_path)) == set(generate.sources())
    generate.write(tmp_path)
    assert generate.outdated(tmp_path) == ()
    (tmp_path / "tanh" / "rigid_bearing.py").write_text("changed")
    (tmp_path / "tanh" / "strange.py").write_text("")
    assert set(generate.write(tmp_path)) == {"tanh/rigid_bearing.py", "tanh/strange.py"}
    assert generate.outdated(tmp_path) == ()


@every_variant
def test_rate_is_the_derived_right_hand_side(variant):
    """(10) and (13) for a rigid support; for a compliant one Archard's law, (7f)."""
    for model, found in signed(variant, "rate"):
        if variant.compliant:
            wanted = substitute(model.wear_laws[2], model.slip).claim.rhs
        else:
            wanted = substitute(model.rigid, model.slip).claim.rhs
        assert is_zero(found - plain(wanted))


@pytest.mark.parametrize("variant", COMPLIANT, ids=map(name_of, COMPLIANT))
def test_residual_is_the_general_implicit_form(variant):
    """(9): the residual at the pressure that belongs to a wear rate."""
    for model, found in signed(variant, "residual"):
        wanted = model.pressure_of_bearing_wear.claim
        assert is_zero(found - plain(wanted.lhs - wanted.rhs))


@every_variant
def test_slopes_are_derivatives(variant):
    """Against derivatives by another route, dual numbers in place of formulas, to 40 digits."""
    made = exact.made(variant)
    functions = {f.name: exact.composed(f)[0] for f in made.functions if f.name != "fields"}
    for at in exact.points(variant, 10)[7:]:
        values = exact.exact_values(variant, at)
        for name, value in derivatives(variant, functions, values).items():
            found = exact.dual(functions[name], values).value
            with mpmath.workdps(exact.DIGITS):
                assert mpmath.almosteq(found, value, rel_eps=mpmath.mpf(10) ** -40), name


@mpmath.workdps(3 * exact.DIGITS)
def derivatives(variant, functions, values):
    """What each generated slope must be."""
    rises = {name: exact.dual(expr, values).slopes for name, expr in functions.items()}
    wanted = {}
    if variant.ends_at_3_sigma:
        wanted["margin_slope"] = rises["margin"]["u"]
    if not variant.compliant:
        return wanted | {"slope": rises["rate"]["u"]}
    per_pressure = rises["rate"]["p"]
    if variant.ends_at_3_sigma:
        per_margin = values["margin_slope"] / values["compliance"]
        wanted["limited_slope"] = values["wear_per_pressure"] * per_margin
    return wanted | {"slope": -per_pressure * rises["residual"]["u"] / rises["residual"]["p"]}


@every_variant
def test_a_pair_is_what_its_halves_are(variant):
    functions = {f.name: f for f in (*exact.made(variant).functions, *joint(variant).values())}
    if not variant.compliant:
        pair, halves = functions["rate_and_slope"], [functions["rate"], functions["slope"]]
        assert pair.results == tuple(half.results[0] for half in halves)
        assert pair.operations < sum(half.operations for half in halves)


def joint(variant):
    return {f.name: f for f in exact.made(variant).joint_functions}


@every_variant
def test_gradients_are_derivatives(variant):
    """With respect to the load and each constant, by dual numbers to 40 digits."""
    made = exact.made(variant)
    functions = {f.name: exact.composed(f)[0] for f in made.functions if f.name != "fields"}
    gradient = exact.composed(joint(variant)["rate_gradient"])
    names = ["U_a", *(name.name for name, _ in made.constants)]
    for at in exact.points(variant, 10)[7:]:
        values = exact.exact_values(variant, at)
        if variant.compliant:  # a pressure is the root for the load that belongs to it
            values["p_max"] = values["p"] / exact.dual(share(variant), values).value
        rate = exact.dual(functions["rate"], values).slopes
        with mpmath.workdps(3 * exact.DIGITS):
            wanted = {name: rate.get(name, 0) for name in names}
            if variant.compliant:
                residual = exact.dual(functions["residual"], values).slopes
                for name in names:
                    wanted[name] -= rate["p"] * residual.get(name, 0) / residual["p"]
        for name, expr in zip(names, gradient, strict=True):
            found = exact.dual(expr, values).value
            with mpmath.workdps(exact.DIGITS):
                assert mpmath.almosteq(found, wanted[name], rel_eps=mpmath.mpf(10) ** -40), name


def share(variant):
    """p/p_max by the contact law, from the residual p - p_max phi."""
    residual = next(f for f in exact.made(variant).functions if f.name == "residual")
    p, p_max = (
        next(s for s in exact.composed(residual)[0].free_symbols if s.name == name)
        for name in ("p", "p_max")
    )
    return ((p - exact.composed(residual)[0]) / p_max).expand()


@pytest.mark.parametrize("pin", Pin)
def test_the_gradient_of_the_margin_is_its_derivative(pin):
    made = margin_program(pin)
    margin = exact.composed(made.functions[0])[0]
    gradient = next(f for f in made.joint_functions if f.name == "margin_gradient")
    for (name, _), found in zip(made.constants, exact.composed(gradient), strict=True):
        assert sp.simplify(found - sp.diff(margin, name)) == 0


@pytest.mark.parametrize("which", [*VARIANTS, *Pin])
def test_gradients_go_back_through_bind(which):
    """By the chain rule from the constants, differentiated one by one, to the parameters."""
    made = exact.made(which) if isinstance(which, Variant) else margin_program(which)
    gradient = next(f for f in made.joint_functions if f.name == "parameter_gradient")
    constants = exact.exact_constants(made)
    for parameter, found in zip(made.parameters, exact.composed(gradient), strict=True):
        chain = (by_constant(c.name) * sp.diff(v, parameter) for c, v in constants.items())
        exactly = found.xreplace(constants)
        assert sp.simplify(exactly - sp.Add(*chain)) == 0, parameter


@pytest.mark.parametrize("pin", Pin)
def test_loss_of_contact_adds_functions_that_know_neither_law_nor_support(pin):
    added = margin_program(pin)
    variants = [v for v in VARIANTS if v.ends_at_3_sigma and v.pin is pin]
    assert len(variants) == 4
    for variant in variants:
        complete = exact.made(variant)
        names = {f.name for f in complete.functions}
        assert [f for f in added.functions if f.name in names] == [
            f for f in complete.functions if f.name in added.operations
        ]
        assert variant.compliant == ("limited_pressure" in names)
        constants = exact.exact_constants(complete)
        for name, value in exact.exact_constants(added).items():
            assert constants[name] == value


@pytest.mark.parametrize("variant", COMPLIANT, ids=map(name_of, COMPLIANT))
def test_a_step_of_newton_is_that_of_the_residual(variant):
    """p - residual/slope, in a form in which nothing cancels, to 40 digits."""
    functions = {f.name: exact.composed(f)[0] for f in exact.made(variant).functions}
    for at in exact.points(variant, 10)[7:]:
        values = exact.exact_values(variant, at)
        residual = exact.dual(functions["residual"], values)
        for name in ("undeflected", "softness"):
            values[name] = exact.dual(functions[name], values).value
        found = exact.dual(functions["newton"], values).value
        with mpmath.workdps(exact.DIGITS):
            wanted = values["p"] - residual.value / residual.slopes["p"]
            terms = abs(values["p"]) + abs(found)
            assert abs(found - wanted) <= terms * mpmath.mpf(10) ** -40


@pytest.mark.parametrize("changed", ["value", "slope"])
def test_a_form_that_is_not_the_law_is_refused(changed):
    law = LAWS["tanh"]
    wrong = replace(law, form=replace(law.form, **{changed: 2 * getattr(law.form, changed)}))
    assert generate.faults_of(wrong) == ("tanh: the form to compute with is not phi",)


def test_the_tail_of_a_law_is_found_where_it_has_one():
    assert tail(LAWS["tanh"]) == (sp.exp(8), 4)
    assert tail(LAWS["exponential"]) == (1, 1)
    two = ContactLaw("two", (sp.exp(-r) + sp.exp(-3 * r)) / 2, -sp.oo, "an example")
    assert tail(two) == (sp.Rational(1, 2), 1)
    power = ContactLaw("power", 1 / (1 + r**2), sp.Integer(0), "an example")
    assert tail(power) == (0, 0)


@pytest.mark.parametrize("stiffness", [1.0, 1e3, 1e12])
@pytest.mark.parametrize("law", LAWS)
def test_pressure_is_found_however_soft_the_support(law, stiffness):
    """Even where the undeflected law would overflow: a gap closed by a thousand roughnesses."""
    variant = exact.variant_of(law, "compliant_bearing")
    module = exact.module_of(variant)
    at = exact.points(variant, 8)[7]
    soft = {**at.parameters, "k": stiffness, "sigma_c0": 1e-6, "h_0": 1e-3}
    constants = exact.bound(module, at._replace(parameters=soft))
    load = 1e-3 + min(0.9 * at.parameters["p_max"] / stiffness, 1.0)
    found = wear.pressure_root.pressure(module, 0.0, load, constants)
    values = {**constants._asdict(), "u": 0.0, "U_a": load, "p": float(found.p)}
    named = {f.name: f for f in exact.made(variant).functions}
    judged = exact.judge_root(named["residual"], values)
    assert judged.units(float(found.p)) <= exact.UNITS


# What it costs


@every_variant
def test_a_variant_has_what_it_needs_and_no_more(variant):
    text = source(exact.made(variant), "numpy")
    module = exact.module_of(variant)
    assert ("sqrt" in text) == variant.pin.rough
    assert ("def residual" in text) == variant.compliant
    assert ("def margin" in text) == variant.ends_at_3_sigma
    assert ("K_a" in module.Parameters._fields) == variant.pin.wears
    assert ("sigma_a0" in module.Parameters._fields) == variant.pin.rough
    assert ("k" in module.Parameters._fields) == variant.compliant
    assert "tanh(" not in text
    assert ("pin_wear_sign" in text) == variant.pin.wears
    assert exact.made(variant).operations == module.OPERATIONS


# How accurate it is


def numbers(variant, at):
    """The constants of a point, as the module binds them."""
    module = exact.module_of(variant)
    return module, exact.bound(module, at)


@st.composite
def drawn(draw):
    variant = draw(st.sampled_from(VARIANTS))
    generator = random.Random(draw(st.integers(0, 2**32)))
    argument = draw(st.floats(-700, 700) | st.floats(-20, 4))
    return variant, exact.point(variant, generator, argument, vanishing=draw(st.booleans()))


@settings(max_examples=120)
@given(drawn())
def test_functions_are_accurate_to_roundoff(case):
    """At most 8 units of roundoff times the sum of the absolute terms, for every function."""
    variant, at = case
    module, constants = numbers(variant, at)
    made = exact.made(variant)
    for function in made.array_functions:
        if function.name == "parameter_gradient":
            continue
        values = exact.inputs(function, at, constants._asdict())
        arguments = [np.float64(values[a.name]) for a in function.arguments]
        found = getattr(module, function.name)(*arguments, constants)
        results = tuple(found) if len(function.results) > 1 else (found,)
        if function.name == "rate_gradient":
            results = (found[0], *found[1])
        for result, exactly in zip(results, exact.judge(function, values), strict=True):
            assert exactly.units(float(result)) <= exact.UNITS, function.name


@settings(max_examples=50)
@given(drawn())
def test_constants_are_accurate_to_roundoff(case):
    variant, at = case
    _, constants = numbers(variant, at)
    for name, expr in exact.exact_constants(exact.made(variant)).items():
        bound = getattr(constants, name.name)
        assert exact.judge_expression(expr, at.numbers).units(bound) <= exact.UNITS
