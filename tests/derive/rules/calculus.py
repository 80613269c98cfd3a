"""Rates and data, limits of data, inequalities."""

from __future__ import annotations

import sympy as sp

from derive.hypotheses import CONTINUOUS, DIFFERENTIABLE, Kind
from derive.kernel import infer
from derive.laws import GENERAL, TANH, r
from derive.note.model import ARCHARD, SLIP, SUPPORT, contact
from derive.note.model import START as STARTS
from derive.rules.algebra import Insert, Solve, substitute
from derive.rules.assumption import assume, defined
from derive.rules.calculus import (
    SPRINGS,
    change_clock,
    differentiate,
    grows,
    integrate,
    rigid,
)
from derive.rules.data import DataDerivative
from derive.rules.inequalities import (
    Arithmetic,
    Lipschitz,
    LogarithmicSlope,
    Monotone,
    Threshold,
)
from derive.rules.limits import later, one_period_later
from derive.symbols import initial, rate, symbol, symbols, t
from tests.derive.judgements import (
    ALMOST,
    BOUNDED,
    CYCLING,
    GROWING,
    PIN_START,
    ROUGHENS,
    SLOPE,
    START,
    Family,
    eq,
    equal,
    ge,
    given,
    gt,
    integral,
    le,
    lt,
    ne,
    opened,
    sloped,
    supposed,
    times,
)

u_c, u_a, U_a, U_c, h, p, G = symbols("u_c u_a U_a U_c h p G")
h_0, f_c, C, T, N, q, k, b, b_0, M, L = symbols("h_0 f_c C T N q k b b_0 M L")
sigma_c0, u_cum, theta, x_inf, tau, omega = symbols("sigma_c0 u_cum theta x_inf tau omega")
U, U_max, p_max, R_a, epsilon, sigma = symbols("U U_max p_max R_a epsilon sigma")
K_a, K_c, H_a, H_c, sigma_a0 = symbols("K_a K_c H_a H_c sigma_a0")
sigma_a, f_ac = symbols("sigma_a f_ac")
y = sp.Symbol("y", real=True)
v, w = (sp.Function(name, real=True)(tau) for name in "vw")
WIGGLE, WOBBLE = (sp.Function(name, real=True)(t) for name in ("wiggle", "wobble"))
du, da = rate("u_c"), rate("u_a")

SMOOTH = assume(DIFFERENTIABLE)
LATER = one_period_later(opened())
SCALED = defined(u_c, sigma_c0 * v)
BOTH = L + b_0
IN_H_0 = sp.Derivative(u_cum, h_0, evaluate=False)
IN_FALLING_ORDER, HIGHER = ge(x_inf, theta), ge(-q, -2 * q, evaluate=False)
WHOLE = sp.Piecewise((1 / f_c, sp.Ge(f_c, L)), (0, True))


def said(relation, kind):
    return assume(supposed(relation, kind))


def valued(name, meaning):
    """Return that a name is L, beside a definition that it occurs in."""
    return Insert(equal(name, L))(eq(name, L), said(meaning, Kind.DEFINITION))


def tied(*ties):
    """Return u_cum = f_c h_0, after h_0 = f_c L was inserted."""
    value = Arithmetic(equal(h_0, f_c * L))(*ties)
    return Insert(equal(u_cum, f_c**2 * L))(defined(u_cum, f_c * h_0), value)


def exceeds(function, level, point, right=sp.Gt, both=sp.Equivalent):
    """Compare a function with a level, and f_c with the point where it has that value."""
    claim = both(sp.Gt(function, level), right(f_c, point))
    return Threshold(claim, f_c)(ROUGHENS)


def beside(*facts):
    """Return u_cum = h_0 f_c under the hypotheses of others, too."""
    return Insert(equal(u_cum, h_0 * f_c))(GROWING, *facts)


def beside_wear(*facts):
    """Return u_cum = h_0 f_c, which is h_0 theta, from its definition by theta."""
    return Insert(equal(u_cum, h_0 * f_c))(defined(u_cum, h_0 * theta, gt(theta, 0)), *facts)


def turned():
    """Return u_cum = T V, where V is R omega."""
    slip = said(SLIP[0], Kind.MODEL)
    speed = Insert(equal(symbol("R") * omega, symbol("V")))(slip)
    return Insert(equal(u_cum, T * symbol("V")))(defined(u_cum, T * symbol("V")), speed)


def deflected():
    """Return that the support is deflected one period later, as it is under any pressure."""
    known, there = one_period_later(Solve(U_c)(assume(SPRINGS))), later(U_c)
    bent = Arithmetic(sp.Ne(there, 0))(known, one_period_later(gt(p, 0)))
    return Insert(equal(later(p) / (k * there), 1))(known, bent)


def unit():
    """Return that p/k over what lies between the solids is 1: it is p/k."""
    inside, known = h - h_0 + U_a, opened()
    open_ = Arithmetic(sp.Ne(inside, 0))(known, gt(p, 0))
    return Insert(equal(p / (k * inside), 1))(known, open_)


def pressed(closure):
    """Return that what lies between the solids is positive: it is p/k."""
    now = closure.claim.lhs == h
    inside = closure.claim.lhs - h_0 + (U_a if now else later(U_a))
    carried = gt(p, 0) if now else one_period_later(gt(p, 0))
    open_ = Arithmetic(sp.Ne(inside, 0))(closure, carried)
    return Insert(equal(sp.Abs(inside) / inside, 1))(closure, open_)


def of_one_start():
    """Return u_cum = f_c sigma_c0, as both solids are equally rough at first."""
    first = said(STARTS[3], Kind.INITIAL), said(STARTS[4], Kind.INITIAL)
    value = Arithmetic(equal(sigma_a0, sigma_c0))(
        *first, eq(initial("sigma_a"), initial("sigma_c"))
    )
    return Insert(equal(u_cum, f_c * sigma_c0))(defined(u_cum, f_c * sigma_a0), value)


def of_one_wear():
    """Return u_cum = h_0 K_c, as both solids wear equally."""
    rates = said(ARCHARD[0], Kind.MODEL), said(ARCHARD[2], Kind.MODEL)
    value = Arithmetic(equal(K_a * H_c / H_a, K_c))(*rates, differentiate(eq(u_a, u_c)), gt(p, 0))
    return Insert(equal(u_cum, h_0 * K_c))(defined(u_cum, h_0 * K_a * H_c / H_a), value)


def by_a_name():
    """Return u_cum = f_c h_0, as the first roughness is h_0."""
    named = defined(b_0, initial("sigma_c") - h_0), eq(b_0, 0), said(STARTS[4], Kind.INITIAL)
    value = Arithmetic(equal(sigma_c0, h_0))(*named)
    return Insert(equal(u_cum, f_c * h_0))(defined(u_cum, f_c * sigma_c0), value)


def uncoupled():
    """Return u_cum = f_c h_0, as a pin that is smooth and unworn has f_ac = 0."""
    settings = differentiate(eq(sigma_a, 0)), differentiate(eq(u_a, 0))
    rates = said(ARCHARD[1], Kind.MODEL), said(ARCHARD[2], Kind.MODEL)
    value = Arithmetic(equal(f_ac, 0))(*settings, *rates, eq(p, p_max * sp.exp(-h / sigma)))
    return Insert(equal(u_cum, f_c * h_0))(defined(u_cum, (f_c + f_ac) * h_0), value)


TIE = sp.sqrt(2 * f_c * L * h_0 - h_0**2 - f_c**2 * L**2)


def pressed_by_the_load(closure, *facts):
    """Return p = k U_a, under a gap that the load and the deflection do not change."""
    return Arithmetic(equal(p, k * U_a))(closure, eq(h, h_0 + u_c), assume(SPRINGS), *facts)


def of_two_values():
    """Return dp/dt = 0 for a pressure of two values under a load that has a rate."""
    moves = pressed_by_the_load(eq(h, h_0 + u_c + U_c - U_a))
    two = eq(p * (p - L), 0)
    rates = differentiate(moves, assume(DIFFERENTIABLE))
    return Arithmetic(equal(rate("p"), 0))(two, differentiate(two, rates))


def repeated_by_a_root():
    """Return p(t + T) = p under a closure that has a value for a load of period T alone."""
    after = U_a.subs(t, t + T)
    nothing = 2 * G * (U_a - U_c) - G * (2 * U_a - 2 * U_c)
    periodic = nothing * sp.sqrt(2 * U_a * after - U_a**2 - after**2)
    closure = given(equal(h, h_0 + u_c + U_c - U_a + periodic))
    now = pressed_by_the_load(closure)
    same = Arithmetic(equal(after, U_a))(closure)
    return Arithmetic(equal(later(p), p))(now, one_period_later(now), same)


def alike(left, right):
    return sp.Equivalent(left, right, evaluate=False)


IN_START, IN_SIGMA, IN_F_AC = (sp.Derivative(u_cum, x) for x in (sigma_a0, sigma_c0, f_ac))
FACTORS = defined(theta, f_c), defined(b_0, h_0 / L)
FIELDS = tuple(
    said(equal(field, value), Kind.DEFINITION)
    for field, value in ((WIGGLE, f_c), (WOBBLE, h_0 / L))
)

FAMILIES = (
    Family(lambda law, start=START, pin=PIN_START: integrate(law, start, pin), (
        eq(du, f_c * da), (eq(du, f_c * da), eq(initial("u_c"), h_0)), eq(du, q * da),
    ), {
        "an inequality between rates": ("no equality", ge(du, f_c * da)),  # u_a = t, u_c = 2 t
        # u_c(0) = 5 h_0
        "an initial value that is only bounded": ("no equality", eq(du, f_c * da),
            ge(initial("u_c"), h_0)),
        # v = tau: u_c = int tau du_a
        "integrated with a factor v(tau)": ("is constant", eq(du, v * da)),
        "integrated with a field": ("is constant", eq(du, u_a * da)),
        "a rate alone": ("dy/dt = c dx/dt", eq(du, C)),
        "initial values of the other": ("at t = 0", eq(du, 2 * da), PIN_START, START),
    }),
    Family(lambda bound, start=START: grows(bound, start), (
        ge(du, C * b_0), (ge(rate("G"), omega), eq(initial("G"), h_0)),
    ), {
        "the number of cycles held fixed": ("constant", ge(du, C * N)),  # u_c = C t^2/(2 T)
        "a bound v(tau) of the rate": ("constant", ge(du, C * v)),  # v = e^-tau
        # u_c(0) = 0
        "a start that is only bounded": ("no equality", ge(du, C), le(initial("u_c"), h_0)),
    }),
    Family(differentiate, (
        eq(u_c, h_0 * t / T), eq(u_c, h_0 * b_0),
        (eq(h, sp.sqrt(u_c)), gt(u_c, 0)),  # u_c = t^2
        (eq(h, h_0 - U_a), SMOOTH),
    ), {
        "the rate of the number of cycles": ("differentiable", eq(u_c, h_0 * N)),  # u_c = h_0 t/T
        # G = u_c + h_0 at t = 0 alone
        "the rate of what is so wherever wear has a rate": ("Derivative", ALMOST),
        # u_c = t^2 sin(1/t)^2, of which the root has no rate at 0
        "the rate of a root where wear has a rate": ("u_c", eq(h, sp.sqrt(u_c)),
            Arithmetic(sp.Gt(u_c, 0))(eq(u_c, T**2 * da**2 / h_0), ne(da, 0))),
        "the rate of v(tau)": ("differentiable", eq(u_c, h_0 * v)),
        "the rate of an inequality": ("no equality", ge(h, 2 * u_c)),
    }),
    Family(rigid, (
        opened(), opened(ROUGHENS), substitute(eq(h, h_0 + U_c - U_a), Solve(U_c)(assume(SPRINGS))),
    ), {
        "k -> oo with U_c held fixed": ("equilibrium", eq(R_a, k * b * L * (U_c - U))),
        "k -> oo under a bounded load": ("nothing else is said", opened(BOUNDED)),
        "a load that is continuous": ("nothing else is said", opened(assume(CONTINUOUS))),
        # p jumps from L to 0
        "a load that has a rate": ("nothing else is said", of_two_values()),
        # p = k (1 + t)
        "a load that repeats by a root": ("nothing else is said", repeated_by_a_root()),
        "a deflection one period later": ("nothing else is said", deflected()),  # 0 = 1
        # 0/0
        "what is pressed one period later": ("nothing else is said", pressed(LATER)),
        "what is pressed": ("continuous for k", pressed(opened())),
        "what is pressed, in units of itself": ("continuous for k", unit()),  # 0 = 1
        "k times an equation": ("continuous for k", times(k, opened())),
    }),
    Family(lambda scaled, clock=CYCLING: change_clock(scaled, clock), (SCALED, eq(u_c, q * v)), {
        "time in periods, with a factor N": ("constant", eq(u_c, N * h_0 * v)),  # u_c = h_0 tau v
        "the rate of v, times what may vanish": ("b_0/T|b_0, 0", eq(u_c, b_0 * v)),  # v jumps
        "time in periods, with a field": ("constant", eq(u_c, h * v)),
        "the rate of what jumps": ("Derivative", eq(h, q * v)),  # a square wave
        # the left side is 0 to SymPy
        "the rate of w = q v, with time held": ("Derivative", eq(w, q * v)),
        # v may be 0 at rational tau
        "the scale where wear has a rate": ("at every time",
            Arithmetic(equal(u_c, q * v))(eq(u_c, q * v + T * (du - C)), eq(du, C))),
        "another clock": ("t = T tau", SCALED, defined(N, t / T)),
        "an inequality in periods": ("no equality", ge(u_c, u_a)),
    }),
    # ---- data
    Family(lambda claim, known=GROWING, datum=f_c,
        *facts: DataDerivative(claim, datum)(known, *facts), (
        equal(SLOPE, h_0), (equal(IN_H_0, f_c), defined(u_cum, f_c * h_0), h_0),
        (equal(SLOPE, h_0), beside(*FACTORS, eq(p, p_max * sp.exp(-h / sigma)))),
        (equal(SLOPE, h_0), beside(*FIELDS, BOUNDED)),
        (equal(SLOPE, h_0), beside(gt(sp.sqrt(f_c), 1))),
        (equal(SLOPE, h_0), beside(defined(q, 1 + f_c**2), gt(q, 2))),
    ), {
        "no datum": ("of the data", equal(SLOPE, h_0), GROWING, b_0),
        # h_0 = 0
        "a slope that is infinite, times what is zero": ("h_0 > 0",
            equal(2 * sp.sqrt(h_0) * sp.Derivative(b_0, h_0), 1), defined(b_0, sp.sqrt(h_0)), h_0),
        "0/0 beside a slope": ("Ne", equal(SLOPE / (f_c - 1), h_0 / (f_c - 1))),
        "d(2 f_c)/d f_c at f_c = 1": ("may vary", equal(SLOPE, 0),
            substitute(defined(u_cum, f_c * h_0), eq(f_c, 1))),
        "another slope": ("the derivative is", equal(SLOPE, 2 * h_0)),
        # u_cum = 5 h_0 f_c
        "the slope of a bound": ("no equality", equal(SLOPE, h_0), ge(u_cum, h_0 * f_c)),
        # theta = tanh(4 - 2/f_c)
        "theta has f_c": ("data alone", equal(SLOPE, 0), eq(u_cum, h_0 * (1 + theta) / 2)),
        # h(0) = h_0: the slope is f_c
        "h(0) held fixed as h_0 varies": ("data alone", equal(IN_H_0, 0),
            defined(u_cum, initial("h") * f_c), h_0),
        "a slope at a value of the datum": ("may vary", equal(SLOPE, h_0), GROWING, f_c,
            eq(f_c, 1)),
        # the slope is f_c
        "two loads that tie h_0 and f_c": ("may vary", equal(IN_H_0, 0),
            tied(eq(U_a, f_c * L), eq(U_a, h_0)), h_0),
        "a name for f_c that is h_0/L": ("may vary", equal(IN_H_0, 0),
            tied(defined(q, f_c), eq(q, h_0 / L)), h_0),
        "two names that are equal": ("may vary", equal(IN_H_0, 0),
            tied(*FACTORS, eq(theta, b_0)), h_0),
        "two names of one pressure": ("may vary", equal(IN_H_0, 0),
            tied(*FACTORS, eq(p, p_max * theta), eq(p, p_max * b_0)), h_0),
        "two fields that are equal": ("may vary", equal(IN_H_0, 0),
            tied(*FIELDS, eq(WIGGLE, WOBBLE)), h_0),
        # it holds at no other h_0 than f_c L
        "two data tied by a root": ("may vary", equal(IN_H_0, 0), tied(gt(TIE, -L)), h_0),
        "two data tied by a root in a bound": ("may vary", equal(IN_H_0, 0),
            tied(le(sp.Abs(U_a), U + sp.Abs(TIE))), h_0),
        "two data tied by a root in a law": ("may vary", equal(IN_H_0, 0), tied(eq(p,
            p_max * (sp.exp(-r) + (h / sigma - r) * TIE))), h_0),
        "two data tied by a root times what a name makes 0": ("may vary", equal(IN_H_0, 0),
            tied(defined(theta, f_c * h_0), gt(f_c + (theta - f_c * h_0) * TIE, 0)), h_0),
        "two data tied by a piece": ("may vary", equal(IN_H_0, 0),
            tied(gt(sp.Piecewise((1, sp.Le((h_0 - f_c * L) ** 2, 0)), (0, True)), 0)), h_0),
        "two data tied by a bound of a name": ("may vary", equal(IN_H_0, 0),
            tied(defined(q, 2 - sp.Piecewise((1, sp.Le((h_0 - f_c * L) ** 2, 0)), (0, True))),
                lt(q, 2)), h_0),
        "a load below what is negative": ("may vary", equal(IN_H_0, 0),
            tied(le(sp.Abs(U_a), -L * (f_c - h_0 / L) ** 2)), h_0),
        # the slope is f_c
        "two starts that are equal": ("may vary", equal(IN_START, 0), of_one_start(), sigma_a0),
        "a start that equals a datum by a name": ("may vary", equal(IN_SIGMA, 0),
            by_a_name(), sigma_c0),
        # f_ac = 0, the slope is h_0
        "two settings of a pin that roughens": ("may vary", equal(IN_F_AC, 0), uncoupled(), f_ac),
        # the slope is h_0 H_c/H_a
        "two wears that are equal": ("may vary", equal(sp.Derivative(u_cum, K_a), 0),
            of_one_wear(), K_a),
        # |U_a| <= U at no other f_c than 1/c, where h = c sigma
        # u_cum = L in one bearing: with u_cum = h_0 f_c the slope is h_0
        "a name that has a value": ("may vary", equal(SLOPE, 0), eq(u_cum, L)),
        "a name that has a value beside a new one": ("may vary", equal(SLOPE, 0),
            valued(u_cum, equal(u_cum + b_0, u_cum + h_0))),
        "a name that equals one without a definition": ("may vary", equal(SLOPE, 0),
            beside_wear(eq(theta, f_c))),
        # with theta = L f_c it is the slope at one value of f_c
        "a bound of a name without a definition": ("may vary", equal(SLOPE, h_0),
            beside(gt(theta, h_0))),
        "an angular speed that may be that of n": ("may vary",
            equal(sp.Derivative(u_cum, symbol("n")), 0), turned(), symbol("n")),
        # under a law that exceeds p_max it is for f_c >= 0 that there are fields: |f_c| is f_c
        "a roughness that may vanish": (">= 0", equal(SLOPE, h_0),
            beside(said(ARCHARD[3], Kind.MODEL))),
        # with each of the next four, fields may exist at one U alone, or from some U on
        "a load within less than U": ("may vary", equal(SLOPE, h_0),
            beside(le(sp.Abs(U_a), U / (1 + (f_c - h_0 / L) ** 2)))),
        "a contact that ends on springs": ("may vary", equal(SLOPE, h_0),
            beside(said(contact(TANH), Kind.MODEL), said(SUPPORT, Kind.MODEL))),
        "a contact that ends": ("may vary", equal(SLOPE, h_0),
            beside(said(contact(TANH), Kind.MODEL))),
        "a first gap": ("may vary", equal(SLOPE, h_0),
            beside(said(STARTS[0], Kind.INITIAL))),
        # the wear may be infinite in finite time, if the pin wears faster than the bearing
        "wear of the pin": ("may vary", equal(SLOPE, h_0),
            beside(said(ARCHARD[0], Kind.MODEL))),
        "a pressure that is a roughness": ("may vary", equal(SLOPE, h_0),
            beside(eq(p, p_max * sp.sqrt(h / sigma)))),
    }),
    Family(lambda slope, *known: Arithmetic(sp.Ge(slope, 0, evaluate=False))(*known), (
        (C * f_c, ROUGHENS),
    ), {
        # p_inf as a function of f_c has another slope under another law
        "a slope and a value of the datum": ("further conditions", SLOPE - f_c, sloped(),
            eq(f_c, h_0)),
        # u_cum = f_c h_0, f_c = h_0: not f_c^2, whose slope is 2 f_c
        "a slope by name and a value of the datum": ("further conditions", u_cum - f_c**2, GROWING,
            Arithmetic(equal(theta, h_0))(defined(theta, SLOPE, sloped()), sloped()),
            eq(f_c, h_0)),
        "the slope of a root": ("Ne|> 0", sp.diff(sp.sqrt(h_0), h_0)),
    }),
    # ---- inequalities
    Family(lambda claim, *known: Arithmetic(claim)(*known), (
        (sp.Ne(f_c, 0), eq(G, 1 / f_c)), (sp.Gt(theta, 0), eq(G, sp.log(theta))),
        (sp.Gt(h, u_a), ge(h - q, u_a)),
        (sp.Ge(rate("U_a") ** 2, 0), SMOOTH), (sp.Gt(U_max, 0), gt(U_max, h_0)),
        (alike(sp.Le(u_a, h_0), sp.Le(u_a - h_0, 0)),),
        (sp.Gt(f_c, -1), ROUGHENS), (sp.Lt(p, 10**6 * p_max), lt(p, p_max)),
    ), {
        "strict and not": ("missing premise", alike(sp.Le(u_a, h_0), sp.Lt(u_a, h_0))),
        "the converse": ("missing premise", alike(sp.Gt(u_a, q), sp.Lt(h, q))),  # u_a = h = 0
        "between what may have no value": ("Ne",
            alike(sp.Le(u_a, 1 / f_c), sp.Le(u_a - 1 / f_c, 0))),
        "a branch that is not taken": ("Ne", sp.Ne(f_c, 0), eq(G, WHOLE)),  # f_c = 0, G = 0
        "an integrand": ("theta > 0", sp.Gt(theta, 0), integral(sp.log(theta), 1)),  # theta = -1
        "strictness in a limit": (r"h\(t\) > u_a", sp.Gt(h, u_a), gt(h + q / M, u_a)),  # h = u_a
        "the square of a rate": ("Derivative", sp.Ge(rate("U_a") ** 2, 0)),  # a square load
    }),
    Family(lambda body, known=IN_FALLING_ORDER: Monotone(sp.Lambda(y, body))(known), (
        2 * y - 1, (-1 / y, ge(h_0 + q, q, evaluate=False)), GENERAL.phi.subs(r, -y),
        (GENERAL.phi.subs(r, y), HIGHER),
    ), {
        "-1/x across its pole": ("monotone", -1 / y),  # 1, -1
        "the pole inside a contact law": ("monotone", GENERAL.phi.subs(r, -1 / y)),
        "the slope of any law": ("monotone", sp.diff(GENERAL.phi, r).subs(r, y), HIGHER),
    }),
    Family(lambda body, at=theta, step=q, factor=L,
        *known: infer(Lipschitz(sp.Lambda(y, body), at, step, factor), *known), (
        -y, (-y, theta, f_c, L, ROUGHENS),
    ), {
        "a slope that is too steep": ("-1 <= ", -2 * y),
        "a root": (">= 0", -sp.sqrt(y)),
        "a step from nowhere": ("f_c", -sp.tanh(y), 1 / f_c),
    }),
    Family(lambda body, a, b, bound: infer(LogarithmicSlope(sp.Lambda(y, body), a, b, bound)), (
        (sp.exp(y), theta, x_inf, 4 + f_c**2), (1 + sp.tanh(y), theta, q, sp.Integer(2)),
    ), {
        # f_c = -1
        "a bound that has no value": ("f_c > 0", sp.exp(y), theta, x_inf, 4 + sp.log(f_c) ** 2),
        "beyond its bound": ("<= 1", 1 + sp.tanh(y), theta, q, sp.S.One),
        "a logarithm of a root": (">= 0", sp.exp(sp.sqrt(y)), q, M, M),
    }),
    Family(exceeds, ((f_c**2, epsilon**2, epsilon), (f_c**2 + q, epsilon**2 + q, epsilon)), {
        "strict if and only if not": ("strict on both", 2 * f_c, epsilon, epsilon / 2, sp.Ge),
        "both at once": ("an equivalence", 2 * f_c, epsilon, epsilon / 2, sp.Gt, sp.And),
        "across a pole": ("Ne", 1 / (f_c - 1), epsilon, 1 + 1 / epsilon),
        "a threshold of either sign": ("b_0 > 0", 2 * f_c, 2 * b_0, b_0),
        "what decreases": ("increases with", -2 * f_c, -2 * q, q),
        "another level": ("the left side is", 2 * f_c, q, q),
    }),
    Family(lambda level: Threshold(sp.Equivalent(
        sp.Gt(3 * sp.Abs(BOTH) / 2 - sp.tanh(sp.Abs(BOTH) + b_0), level),
        sp.Gt(BOTH, L + h_0, evaluate=False), evaluate=False), BOTH)(gt(BOTH, 0)), (
        sp.Rational(3, 2) * (L + h_0) - sp.tanh(L + h_0 + b_0),
    ), {
        # L, b_0, h_0 = 1/10, 1/5, 1/100: the function of L + b_0 once, not twice
        "a level by parts of the bound": ("the left side is",
            sp.Rational(3, 2) * (L + h_0) - sp.tanh(L + 2 * h_0)),
    }),
    Family(lambda function, point, *known: Threshold(
        sp.Equivalent(sp.Gt(function, q), sp.Gt(u_c, point)), u_c)(*known), (
        (2 * u_c, q / 2), (u_c * h_0 + q, 0, gt(h_0, 0)),
    ), {
        # u_c = q + C (t - T)
        "a wear and its rate": ("Derivative", u_c + T * du, q),
        "a wear times what may be negative": ("increases with", u_c * G, q / G, ne(G, 0)),
        "a square": ("increases with", u_c**2 / q, q),  # u_c = -2 q
    }),
)  # fmt: skip
