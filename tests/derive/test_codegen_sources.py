"""C, Fortran and JavaScript: compiled, run, and as accurate as the NumPy code."""

import ctypes
import decimal
import importlib
import math
import re
from pathlib import Path

import pytest
import sympy as sp

import wear.pressure_root
from derive.codegen.emit import FORTRAN, TARGETS, C, EmitError, emit
from derive.codegen.formulas import Formula, formula_module
from derive.codegen.increment import increment
from derive.codegen.sources import source
from derive.laws import ContactLaw, r
from derive.note.governing import Pin
from derive.variant import VARIANTS, Variant
from tests.derive import exact
from tests.derive.compiled import FLAGS, PASSED, library, names_of_outputs, number, outputs
from tests.derive.reading_back import read_back
from tests.programs import run

every_target = pytest.mark.parametrize("target", TARGETS.values(), ids=TARGETS)
RUN = (
    "tanh/rigid_bearing",
    "tanh/rigid_worn_rough_ends_at_3_sigma",
    "tanh/compliant_rough",
    "tanh/compliant_worn_rough_ends_at_3_sigma",
    "exponential/rigid_rough_ends_at_3_sigma",
    "exponential/compliant_worn",
)
every_run = pytest.mark.parametrize("name", RUN)
COUNT = 30


# What is refused


@every_target
@pytest.mark.parametrize(
    "expr",
    [
        sp.gamma(sp.Symbol("x")),
        sp.Function("f")(sp.Symbol("x")),
        sp.tanh(sp.Symbol("x")),
        sp.I * sp.Symbol("x"),
        sp.sqrt(sp.Symbol("x") * sp.I),
        sp.oo + sp.Symbol("x", positive=True) * sp.I,
        sp.Symbol("x") ** sp.Symbol("y"),
        sp.Symbol("x") ** sp.Rational(1, 3),
        sp.Symbol("x; system"),
        sp.Symbol("sigma'"),
        sp.Symbol("1x"),
        sp.Symbol("_x"),
        sp.Symbol("x\n"),
        sp.Symbol("\u03c3"),
        sp.Symbol(""),
        sp.Piecewise((1, sp.Symbol("x") > 0), (0, True)),
        sp.Min(*sp.symbols("x y z")),
    ],
    ids=str,
)
def test_what_a_target_has_no_word_for_is_refused(target, expr):
    with pytest.raises(EmitError):
        emit(expr, target)


def test_an_unknown_target_is_refused():
    with pytest.raises(
        ValueError, match=r"'rust' is no target; there are numpy, c, fortran, javascript, header"
    ):
        source(exact.made(VARIANTS[0]), "rust")


# How expressions are written


def as_sympy(text: str) -> sp.Expr:
    """An expression that a target has written, read again as SymPy's own."""
    text = re.sub(r"_dp\b|Math\.|np\.|wear_", "", text)
    words = {"sqrt": sp.sqrt, "exp": sp.exp, "pi": sp.pi, "PI": sp.pi}
    words |= dict.fromkeys(("minimum", "smaller", "min"), sp.Min)
    words |= dict.fromkeys(("maximum", "larger", "max"), sp.Max)
    words |= {name: sp.Symbol(name) for name in ("x", "y", "z")}
    return sp.nsimplify(read_back(text.replace("3.141592653589793", "pi"), words))


x, y, z = sp.symbols("x y z")


ALGEBRAIC = ContactLaw(
    "algebraic",
    1 / (1 + (1 + r) ** 2) ** sp.Rational(3, 2) + 1 / (sp.Rational(9, 2) + r**2),
    sp.Integer(0),
    "an example with half-integer powers and a fraction",
)


@pytest.mark.parametrize("language", TARGETS)
@pytest.mark.parametrize("compliant", [False, True])
def test_an_algebraic_law_can_be_written(language, compliant):
    variant = Variant(ALGEBRAIC, compliant, Pin.WORN_ROUGH)
    assert "sqrt(" in source(exact.made(variant), language)


def test_formulas_are_exact_in_decimal(tmp_path, monkeypatch):
    """No number of 17 digits comes between those of 40."""
    share = Formula("share", (r,), ALGEBRAIC.phi, "share")
    slope = Formula("slope", (r,), sp.diff(ALGEBRAIC.phi, r), "slope")
    (tmp_path / "written_law.py").write_text(formula_module("A law.", ("4",), (share, slope)))
    monkeypatch.syspath_prepend(str(tmp_path))
    written = importlib.import_module("written_law")
    for function, expr in ((written.share, share.value), (written.slope, slope.value)):
        with decimal.localcontext(prec=40):
            found = function(decimal.Decimal(7) / 8)
        assert isinstance(found, decimal.Decimal)
        assert abs(sp.Float(str(found), 40) - expr.subs(r, sp.Rational(7, 8)).evalf(50)) < 1e-36


@every_target
@pytest.mark.parametrize(
    "expr",
    [
        x - y - (z - 1),
        x / (y * z),
        x / (y / z),
        1 / x**2,
        y / x**2,
        -(x**2),
        (-x) ** 3,
        (x + y) ** 2 / (x - y) ** 3,
        x / y / z * 2,
        -2 * x / 3,
        sp.Rational(1, 2) * x,
        x * (y + 1) / (2 * (z - 1)),
        sp.exp(-x) - sp.exp(sp.Min(8 - 4 * x, 709)),
        sp.sqrt(x**2 + y**2),
        1 / sp.sqrt(x),
        sp.Max(0, sp.Min(x, y / z)),
        sp.pi * x / 90,
        x - sp.Float(0.1),
        x ** sp.Rational(3, 2),
        (1 + x**2) ** sp.Rational(7, 2) / 3,
        2 * y / x ** sp.Rational(3, 2),
        (x + y) ** sp.Rational(-5, 2),
        x - y / (1 + x**2) ** sp.Rational(3, 2),
        x / 3 - sp.Rational(9, 2) - y / 5,
        x * (y - sp.Rational(1, 3)) ** 2,
    ],
    ids=str,
)
def test_what_is_written_reads_back(target, expr):
    assert sp.simplify(as_sympy(emit(expr, target)) - expr) == 0


@pytest.mark.parametrize("target", [C, FORTRAN], ids=lambda target: target.name)
def test_no_integer_divides_an_integer(target):
    assert as_sympy(emit(sp.Rational(1, 3), target)) == sp.Rational(1, 3)
    assert re.fullmatch(r"1\.0(_dp)? / 3\.0(_dp)?", emit(sp.Rational(1, 3), target))


@pytest.mark.parametrize("language", ["c", "fortran", "javascript"])
def test_sources_tell_what_they_are(language):
    for variant in VARIANTS[::7]:
        text = source(exact.made(variant), language)
        head = re.sub(r"\s+(\*|!)?\s*", " ", text[:1500])
        for identifier in variant.equations:
            assert f"({identifier})" in head
        for function in exact.made(variant).functions:
            assert f" {function.name} {function.operations}" in head
        for parameter in exact.made(variant).parameters:
            assert re.search(rf"\b{parameter.name}\b.{{1,4}}\S.*, ?\S", text), parameter
        assert max(map(len, text.splitlines())) <= 132
        assert "pow(" not in text
        assert "tanh(" not in text


# Every variant compiles, without a warning


@pytest.mark.parametrize(
    ("language", "compiler", "options"),
    [
        ("c", "gcc", ("-std=c99", "-pedantic", "-Wextra")),
        ("fortran", "gfortran", ("-std=f2008", "-ffree-form")),
    ],
)
def test_every_source_is_clean(language, compiler, options, need_tool, tmp_path):
    program = need_tool(compiler)
    for index, variant in enumerate(VARIANTS):
        (tmp_path / f"{index}.{language}").write_text(source(exact.made(variant), language))
    files = sorted(map(str, tmp_path.glob(f"*.{language}")))
    kind = {"c": "c", "fortran": "f95"}[language]
    run(program, *options, *FLAGS, "-fsyntax-only", "-x", kind, *files, cwd=tmp_path)


def test_every_javascript_source_is_a_module(need_tool, tmp_path):
    node = need_tool("node", "nodejs")
    names = []
    for index, variant in enumerate(VARIANTS):
        (tmp_path / f"{index}.mjs").write_text(source(exact.made(variant), "javascript"))
        names.append(f"import * as m{index} from './{index}.mjs';")
    (tmp_path / "all.mjs").write_text("\n".join(names) + "\nconsole.log(Object.keys(m0).length);")
    assert int(run(node, str(tmp_path / "all.mjs"))) == 5


# And computes the same


@pytest.fixture(scope="module")
def wanted():
    """The judged outputs of each variant at its points, computed once."""
    known = {}

    def of(name):
        if name not in known:
            variant = exact.variant_of(*name.split("/"))
            rows = exact.points(variant, COUNT)
            known[name] = variant, rows, [judged(variant, at) for at in rows]
        return known[name]

    return of


def judged(variant, at):
    """Every output at a point, at 50 digits."""
    module = exact.module_of(variant)
    constants = exact.bound(module, at)
    made = exact.made(variant)
    by_name = {f.name: f for f in made.functions}
    values = {**at.state, **constants._asdict()}
    plain, _ = names_of_outputs(variant)
    known = {
        f.name: exact.judge(f, exact.inputs(f, at, constants._asdict())) for f in made.functions
    }
    found = [*(known[name][0] for name in plain), *known["fields"]]
    if not variant.compliant:
        (rate,) = known["rate"]
        cut = variant.ends_at_3_sigma and known["margin"][0].value < 0
        return [*found, exact.Judged(0 * rate.value, rate.unit) if cut else rate]
    near = float(wear.pressure_root.pressure(module, at.u, at.U_a, constants).p)
    root = exact.judge_root(by_name["residual"], {**values, "p": near})
    if variant.ends_at_3_sigma:
        (margin,) = known["margin"]
        at_margin = {**values, "p": root.value, "margin": margin.value}
        (limited,) = exact.judge(by_name["limited_pressure"], at_margin)
        unit = root.unit + limited.unit + margin.unit / constants.compliance
        root = exact.Judged(limited.value, unit)
    speed = constants.wear_per_pressure
    return [*found, root, exact.Judged(speed * root.value, speed * (2 * root.unit))]


@every_run
@pytest.mark.parametrize("language", ["c", "fortran", "javascript"])
def test_compiled_code_is_accurate_to_roundoff(language, name, need_tool, tmp_path, wanted):
    """At most 8 units of roundoff times the sum of the absolute terms, as the NumPy code."""
    variant, rows, references = wanted(name)
    found = outputs(language, variant, rows, tmp_path, need_tool)
    for numbers, reference in zip(found, references, strict=True):
        for value, one in zip(numbers, reference, strict=True):
            assert one.units(value) <= exact.UNITS


@pytest.mark.parametrize("language", ["c", "fortran", "javascript"])
def test_not_a_number_is_not_hidden(language, need_tool, tmp_path):
    """fmin and Fortran's min would make a full pressure of it."""
    variant = exact.variant_of("tanh", "rigid_bearing")
    at = exact.points(variant, 1)[0]._replace(u=math.nan)
    ((rate, *_),) = outputs(language, variant, [at], tmp_path, need_tool)
    assert math.isnan(rate)


# Laws for finite element codes


def test_every_c_source_is_what_its_header_declares(need_tool, tmp_path):
    compiler, plus = need_tool("gcc"), need_tool("g++")
    for name in RUN:
        variant = exact.variant_of(*name.split("/"))
        (tmp_path / "wear_model.h").write_text(source(exact.made(variant), "header"))
        (tmp_path / "wear_model.c").write_text(source(exact.made(variant), "c"))
        flags = ("-fsyntax-only", "-Wmissing-prototypes", "-Wall", "-Wextra", "-Werror")
        run(compiler, "-std=c99", *flags, "-include", "wear_model.h", "wear_model.c", cwd=tmp_path)
        (tmp_path / "user.cpp").write_text('#include "wear_model.h"\n#include "wear_model.h"\n')
        run(plus, "-fsyntax-only", "-Wall", "-Werror", "user.cpp", cwd=tmp_path)


@pytest.mark.parametrize("law", ["tanh", "exponential"])
def test_the_contact_pressure_and_its_derivative_are_those_of_the_law(law, need_tool, tmp_path):
    """At closures from deep in contact to far apart; nothing is hidden at none."""
    variant = exact.variant_of(law, "rigid_bearing")
    law_of_c = library("c", variant, tmp_path, need_tool).wear_contact_pressure

    def found(closure):
        pressure, slope = number(), number()
        given = map(number, (closure, 2.0**-11, 300.0))
        law_of_c(*given, ctypes.byref(pressure), ctypes.byref(slope))
        return pressure.value, slope.value

    assert all(map(math.isnan, found(math.nan)))
    forms = (300 * variant.law.phi, 300 * sp.diff(variant.law.phi, r) * 2**11)
    for ratio in (-3.0, 0.25, 1.0, 2.5, 7.0, 60.0):
        wanted = [float(form.subs(r, sp.Rational(ratio)).evalf(50)) for form in forms]
        assert found(2.0**-11 * ratio) == pytest.approx(wanted, rel=1e-14, abs=0)


STUB = """
module calls
  implicit none
contains
  subroutine wanted(pressure)
    use, intrinsic :: iso_fortran_env, only: dp => real64
    real(dp), intent(in) :: pressure
    real(dp) :: ulocal(2), frame(2, 2), time(2), pnewdt
    integer :: lsmooth, none(1)
    common /contact/ p
    real(dp) :: p
    p = pressure
    ulocal = [0.25_dp, 0.5_dp]
    frame = 0
    time = 0
    pnewdt = 1
    lsmooth = 0
    none = 0
    call umeshmotion(8.0_dp, ulocal, 1, 2, 3, frame, 2, time, 0.125_dp, pnewdt, 1, 1, 0, none, &
      none, lsmooth)
    print *, ulocal
  end subroutine wanted
end module calls
program stub
  use calls
  use, intrinsic :: iso_fortran_env, only: dp => real64
  call wanted(0.0_dp)
  call wanted(100.0_dp)
end program stub
subroutine getnodetoelemconn(node, number, elements, kinds, status, block)
  integer :: node, number, elements(*), kinds(*), status, block(*)
  elements(1) = node; kinds(1) = block(1); number = 1; status = 0
end subroutine
subroutine getvrmavgatnode(node, kind, name, values, status, elements, number, types, block)
  use, intrinsic :: iso_fortran_env, only: dp => real64
  integer :: node, kind, status, elements(*), number, types(*), block(*)
  character(*) :: name
  real(dp) :: values(15), p
  common /contact/ p
  status = merge(0, 1, name == 'CSTRESS' .and. node + kind + number + types(1) + block(1) >= 0)
  values = 0
  values(1) = p + 0 * elements(1)
end subroutine
"""


def test_umeshmotion_moves_a_node_inwards_by_archards_law(need_tool, tmp_path):
    compiler = need_tool("gfortran")
    variant = exact.variant_of("tanh", "rigid_bearing")
    example = (Path(__file__).parents[2] / "docs/examples/umeshmotion.f90").read_text()
    (tmp_path / "user.f90").write_text(source(exact.made(variant), "fortran") + example)
    (tmp_path / "stub.f90").write_text(STUB)
    run(compiler, "-O2", "user.f90", "stub.f90", "-o", "stub", cwd=tmp_path)
    untouched, worn = run(str(tmp_path / "stub")).splitlines()
    assert [float(number) for number in untouched.split()] == [0.25, 0.5]
    velocity = 8.0 * 1e-6 * 100.0 * 4607.669 / (3 * 200.0)
    assert [float(number) for number in worn.split()] == pytest.approx([0.25, 0.5 - velocity])


@pytest.mark.parametrize("language", ["c", "fortran"])
@pytest.mark.parametrize("module", ["rigid_bearing", "rigid_worn", "rigid_worn_rough"])
def test_increments_add_up_to_the_wear_that_the_model_has(module, language, need_tool, tmp_path):
    """Ten unequal increments at constant pressure: wear and roughness of the generated fields."""
    variant = exact.variant_of("tanh", module)
    made = increment(variant)
    at = exact.points(variant, 8)[7]
    states = [name.name for name, _ in made.growth]
    start = dict.fromkeys(states, 0.0)
    start["sigma_c"] = at.parameters["sigma_c0"]
    if "sigma_a" in start:
        start["sigma_a"] = at.parameters["sigma_a0"]
    data = [at.parameters[s.name] for s in made.parameters]
    compiled, passed = library(language, variant, tmp_path, need_tool), PASSED[language]
    advance = compiled[{"c": "wear_increment", "fortran": "wear_increment_"}[language]]
    ends = [number(start[state]) for state in states]
    for i in range(1, 11):
        advance(*map(passed, (100.0, 4.0, 0.1 * i, *data)), *map(ctypes.byref, ends))
    found = dict(zip(states, (end.value for end in ends), strict=True))
    p = at.parameters
    worn = p["K_c"] * 100.0 * 4.0 * 5.5 / (3.0 * p["H_c"])
    assert found["u_c"] == pytest.approx(worn, rel=1e-14)
    generated = importlib.import_module(f"wear.generated.tanh.{module}")
    fields = generated.fields(found["u_c"], 0.0, exact.bound(generated, at))
    for name in states[1:]:
        assert found[name] == pytest.approx(getattr(fields, name), rel=1e-13), name
