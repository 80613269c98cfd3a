"""The rules refuse what their theorems do not cover, and name the premise that is missing.

The tables stand in the modules beside this one, by the rules that they are about.  Every true
statement is one that a rule refuses when one of its premises is dropped.  A rule without a true
statement fails here, and so does a refusal that no statement brings about: whoever adds a rule, or
a side condition, adds the case in which it is not met.
"""

from __future__ import annotations

import ast
import inspect
import re
import traceback
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path

import pytest
import sympy as sp

from derive import rules
from derive.kernel import Judgement, Rule, RuleError, infer, replay_fault
from derive.language import names
from derive.laws import ContactLaw, r
from derive.reals import sign
from derive.results.steady_state import steady_state
from derive.rules.algebra import substitute
from derive.rules.assumption import assume, defined
from derive.rules.calculus import differentiate
from derive.rules.limits import later, one_period_later
from derive.rules.reading import replaced
from derive.symbols import rate, symbol, symbols, t
from derive.zero import is_zero
from tests.derive import test_language
from tests.derive.judgements import eq, ge, ne, supposed
from tests.derive.rules import algebra, asymptotics, calculus, limits, solutions

ROOM = Path(inspect.getfile(rules)).parent
FAMILIES = tuple(
    family
    for table in (algebra, calculus, limits, asymptotics, solutions)
    for family in table.FAMILIES
)

u_c, u_a, U_a, h, p = symbols("u_c u_a U_a h p")
h_0, f_c, L, T, U, p_max = symbols("h_0 f_c L T U p_max")
y = sp.Symbol("y", real=True)

Application = Callable[[], Judgement]


def application(build: Callable[..., Judgement], arguments: object) -> Application:
    return partial(build, *arguments) if isinstance(arguments, tuple) else partial(build, arguments)


TRUE = [application(family.build, arguments) for family in FAMILIES for arguments in family.true]
FALSE = {
    name: (said, application(family.build, tuple(arguments)))
    for family in FAMILIES
    for name, (said, *arguments) in family.false.items()
}


@cache
def made() -> dict[type[Rule], list[Judgement]]:
    """Return the true statements by their rule."""
    found: dict[type[Rule], list[Judgement]] = {}
    for judgement in [build() for build in TRUE]:
        found.setdefault(type(judgement.rule), []).append(judgement)
    return found


@cache
def dropped(known: Judgement) -> tuple[RuleError | Judgement, ...]:
    """Return how a rule refuses without each of its premises in turn, or what it gives then."""
    return tuple(
        attempt(partial(infer, known.rule, *known.parents[:place], *known.parents[place + 1 :]))
        for place in range(len(known.parents))
    )


@cache
def attempt(build: Application) -> RuleError | Judgement:
    try:
        return build()
    except RuleError as refusal:
        return refusal


def kinds(kind: type[Rule] = Rule) -> Iterator[type[Rule]]:
    for rule in kind.__subclasses__():
        if rule.__module__.startswith(rules.__name__) and not inspect.isabstract(rule):
            yield rule
        yield from kinds(rule)


def test_no_two_cases_have_one_name() -> None:
    assert len(FALSE) == sum(len(family.false) for family in FAMILIES)


@pytest.mark.parametrize("name", FALSE)
def test_what_is_false_is_refused(name: str) -> None:
    said, build = FALSE[name]
    refusal = attempt(build)
    assert isinstance(refusal, RuleError)
    assert re.search(said, str(refusal))


@pytest.mark.parametrize("kind", sorted(kinds(), key=str), ids=lambda kind: kind.__name__)
def test_a_rule_gives_what_is_true_and_needs_each_premise(kind: type[Rule]) -> None:
    """The refusal says a name of the dropped premise, what the rule rests on, or the claim."""
    for known in made()[kind]:
        assert replay_fault(known) is None
        for premise, found in zip(known.parents, dropped(known), strict=True):
            if isinstance(found, Judgement):  # of another claim, or it supposes what is missing
                supposes = set(found.hypotheses) - set(known.hypotheses)
                assert supposes or found.claim != known.claim, premise.relation
                continue
            said = [name for name, _ in names(premise.relation)] + [
                *kind.premise_names,
                str(known.relation),
            ]
            assert any(word in str(found) for word in said), (premise.relation, found)


def test_every_refusal_of_the_rules_is_brought_about() -> None:
    """A line of a rule that refuses, or asks for a condition, and never did is not tested."""
    assumed = (partial(assume, supposed(said, kind)) for kind, said, _ in test_language.MISCALLED)
    found = [attempt(build) for build in (*(build for _, build in FALSE.values()), *assumed)]
    found += [each for of_a_rule in made().values() for one in of_a_rule for each in dropped(one)]
    hit = {
        (Path(frame.filename).name, frame.lineno)
        for error in found
        if isinstance(error, RuleError)
        for frame in traceback.extract_tb(error.__traceback__)
    }
    sites = {(path.name, line) for path in ROOM.glob("*.py") for line in asked(path)}
    assert sorted(sites - hit) == []


def asked(path: Path) -> Iterator[int]:
    """Yield the lines of a module on which a rule refuses or asks for a condition."""
    helpers = {"require", "require_defined", "require_hypothesis"}
    for node in ast.walk(ast.parse(path.read_text())):
        called = node.func if isinstance(node, ast.Call) else None
        if isinstance(called, ast.Name) and called.id in helpers:
            yield called.lineno
        if isinstance(node, ast.Raise):
            yield node.lineno


def test_special_values_stay_hypotheses() -> None:
    special = substitute(eq(h, f_c * u_a), eq(f_c, 1))
    assert sp.Eq(f_c, 1) in {hypothesis.relation for hypothesis in special.hypotheses}


def test_what_a_definition_supposes_is_proved_at_every_time() -> None:
    """What wear with a rate tells of G may fail where it has none."""
    z, G = sp.Symbol("z", positive=True), symbol("G")
    named = defined(z, G**2, eq(G**2, T**2 * rate("u_c") ** 2 / L**2), ne(rate("u_c"), 0))
    assert sp.Gt(G**2, 0) in {hypothesis.relation for hypothesis in named.conditions}


def test_rates_and_later_times_of_what_always_holds() -> None:
    assert differentiate(eq(h, 2 * u_c)).claim.rhs == 2 * rate("u_c")
    assert one_period_later(ge(u_c, h_0)).claim.greater == later(u_c)


def test_what_holds_at_every_time_is_inserted_under_time() -> None:
    """t may be bound: an equality of fields holds at every time."""
    mean = sp.Integral(U_a, (t, 0, T))
    assert replaced(mean, U_a, U * sp.sin(t)) == sp.Integral(U * sp.sin(t), (t, 0, T))
    assert replaced(rate("u_c"), u_c, u_a) == rate("u_a")


@pytest.mark.parametrize(
    ("expr", "found"),
    [(sp.exp(y), 1), (sp.tanh(y) - 2, -1), (sp.tanh(y), None), (1 - sp.tanh(y) ** 2, 1)],
)
def test_sign_is_told_only_where_it_is_proved(expr: sp.Expr, found: int | None) -> None:
    assert sign(expr) == found


@pytest.mark.parametrize("shift", [0, 2])
def test_a_law_of_square_roots_has_a_steady_state(shift: int) -> None:
    """Its positivity is no matter of exponentials: a root outweighs what it is of."""
    distance = r - shift
    phi = (1 - distance / sp.sqrt(1 + distance**2)) / 2
    limit = steady_state(ContactLaw("algebraic", phi, sp.Integer(shift), "a test"))
    assert is_zero(limit.pressure.claim.value / symbol("p_max") - phi.subs(r, 1 / symbol("f_c")))
    assert replay_fault(limit.growth) is None
