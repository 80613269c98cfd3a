"""False statements with a true neighbour each, as hypotheses and claims.

A row: what is said; the hypotheses; the false claim; the hypotheses that were missing (or None),
and what then is true (the same claim, unless another is given).  They are tried on models, not
built by rules.
"""
# ruff: noqa: E501 - a row is read as one line

from dataclasses import dataclass, field

import sympy as sp

from derive.laws import GENERAL, r
from derive.symbols import initial, rate, symbols, t

h, u_a, u_c, U_a, U_c, sigma, sigma_a, sigma_c, p, G, G_inf, R_a = symbols(
    "h u_a u_c U_a U_c sigma sigma_a sigma_c p G G_inf R_a"
)
h_0, h_star, f_a, f_c, q, L, T, C, V, U, N, M, b, k = symbols(
    "h_0 h_star f_a f_c q L T C V U N M b k"
)
theta, x_inf, tau, omega, kappa, epsilon, b_0, mu = (
    *symbols("theta x_inf tau omega kappa epsilon b_0"),
    sp.Symbol("mu", positive=True),
)
K_a, K_c, H_a, H_c, p_max, sigma_a0, sigma_c0 = symbols("K_a K_c H_a H_c p_max sigma_a0 sigma_c0")
U_mean, U_max, U_min, u_cum, u_stop, rho, m, c_2 = symbols(
    "U_mean U_max U_min u_cum u_stop rho m c_2"
)

Eq, Ne, Gt, Ge, Lt, Le, exp, log = sp.Eq, sp.Ne, sp.Gt, sp.Ge, sp.Lt, sp.Le, sp.exp, sp.log


def forever(expr: sp.Expr) -> sp.Limit:
    return sp.Limit(expr, t, sp.oo)


def later(field: sp.Expr) -> sp.Expr:
    return field.subs(t, t + T)


def acceleration(field: sp.Expr) -> sp.Expr:
    return sp.Derivative(field, (t, 2))


def slope(name: sp.Symbol, datum: sp.Symbol) -> sp.Expr:
    return sp.Derivative(name, datum, evaluate=False)


def load_at(time: sp.Symbol) -> sp.Expr:
    return U_a.subs(t, time)


_s = sp.Symbol("s", real=True)
du = rate("u_c")
START = Eq(initial("u_c"), 0)
BOUNDED = Le(sp.Abs(U_a), U)
CONSTANT = Eq(rate("U_a"), 0)
PERIODIC = Eq(later(U_a), U_a)
MEAN = Eq(U_mean, sp.Integral(load_at(_s), (_s, 0, T)) / T)
SINE = Eq(U_a, U * sp.sin(2 * sp.pi * t / T))
GROWS = Eq(forever(u_c), sp.oo)
SIZE = sigma_c0 + f_c * u_c
GAP = h_0 + u_c - U_a
FAST = K_c * V * p_max / (3 * H_c)
RATE = Eq(du, FAST * (1 + sp.tanh(4 - 2 * GAP / SIZE)) / 2)
TAIL = Eq(du, FAST * exp(8 - 4 * (h_0 + u_c - U_a) / sigma_c0))
LARGEST = Eq(M, FAST * T)
STEADY = FAST * (1 + sp.tanh(4 - 2 / f_c)) / 2
DRIFT = 4 * (1 - (1 + sp.tanh(4 - 2 / f_c)) / 2) * (sigma_c0 / f_c - h_0 + U_mean) / f_c
ODDS = log(p / (p_max - p))
LAW = Eq(p, p_max / (1 + exp(4 * h / sigma - 8)))
GROWN = Eq(sigma, SIZE)
SHARE = 1 / (exp(4 / f_c - 8) + 1)
THRESHOLD = 4 / (8 + log(1 / epsilon - 1))
SMALL = Lt(epsilon, 1 / (1 + exp(-8)))
ROUNDS = (
    sigma_c0
    / 4
    * log(1 + 4 * M / sigma_c0 * exp(8 - 4 * h_0 / sigma_c0) * sp.besseli(0, 4 * U / sigma_c0))
)
FULL_MODEL = (
    Eq(h, h_0 + u_c + U_c - u_a - U_a),
    Eq(sigma, sp.sqrt(sigma_a**2 + sigma_c**2)),
    Eq(p, p_max * (1 + sp.tanh(4 - 2 * h / sigma)) / 2),
    Eq(rate("u_a"), K_a * p * V / (3 * H_a)),
    Eq(du, K_c * p * V / (3 * H_c)),
    Eq(rate("sigma_a"), f_a * rate("u_a")),
    Eq(rate("sigma_c"), f_c * du),
    START,
    Eq(initial("u_a"), 0),
    Eq(initial("sigma_a"), sigma_a0),
    Eq(initial("sigma_c"), sigma_c0),
    Gt(sigma_c, 0),
)
LOGARITHM = forever((u_c - C * t) / log(t / T))
REMAINDER = forever(t * (du - C) - U_a)
_phi = GENERAL.phi.func
_softer = sp.Subs(sp.Derivative(_phi(r), r), r, -q), sp.Subs(sp.Derivative(_phi(r), r), r, -2 * q)
_size = sp.sqrt(sigma_c0**2 + 2 * h_star * u_c)
_below = 1 / f_c + (sigma_c0 / f_c + h_0 + U) / sigma_c0
_odds_form = Eq(f_c, (4 * h / (8 - ODDS) - sigma_c0) / u_c)
_level = Eq(log(t / T), 4 * h_star / SIZE - 8 + 4 / f_c + log(SIZE**2 / (-4 * f_c * h_star * M)))
_saturating = (
    RATE,
    START,
    Eq(U_a, U_mean),
    Lt(f_c, 0),
    LARGEST,
    Eq(h_star, h_0 - sigma_c0 / f_c - U_mean),
)
_c_1 = b_0 * (2 - 2 * theta)
_constants = (Eq(b_0, sigma_c0 / f_c - h_0), Eq(theta, sp.tanh(4 - 2 / f_c)), Gt(f_c, 0))
_jump = sp.Lambda(r, sp.Piecewise((1, r < 1000), (2, True)))
_drop = sp.Lambda(r, sp.Piecewise((r, r < 0), (r - 1, True)))
_smooth_time = (sigma_c0 / 8 * (exp(4 * u_c / sigma_c0) - 1)) * exp(
    4 * (h_0 - U_a) / sigma_c0 - 8
) + u_c / 2


@dataclass(frozen=True)
class Case:
    said: str
    given: tuple[sp.Basic, ...]
    false: sp.Basic
    missing: tuple[sp.Basic, ...] = ()
    true: sp.Basic | None = None
    without: tuple[sp.Basic, ...] = field(default=())

    @property
    def neighbour(self) -> tuple[tuple[sp.Basic, ...], sp.Basic]:
        """Return the true statement near this one."""
        kept = tuple(g for g in self.given if g not in self.without)
        return (*kept, *self.missing), self.false if self.true is None else self.true


CASES = (
    # relations and algebra
    Case("an inequality is no equation", (Eq(h, u_a), Ge(u_a, h_0)), Eq(h, h_0), (), Ge(h, h_0)),
    Case("an inequation is no equation", (Eq(h, u_a), Ne(u_a, h_0)), Eq(h, h_0), (), Ne(h, h_0)),
    Case("an inequality is not solved", (Ge(u_a, h_0),), Eq(u_a, h_0), (Le(u_a, h_0),)),
    Case("nor multiplied", (Ge(u_a, h_0),), Eq(q * u_a, q * h_0), (), Ge(q * u_a, q * h_0)),
    Case("a factor may vanish", (Eq(f_c * u_a, f_c * h_0),), Eq(u_a, h_0), (Ne(f_c, 0),)),
    Case("divided by zero", (Eq(h, u_a),), Eq(h / f_c, u_a / f_c), (Ne(f_c, 0),)),
    Case("G still varies", (Eq(T * rate("G") + G, theta),), Eq(G, theta), (Eq(rate("G"), 0),)),
    Case(
        "a squeeze with a part too many",
        (Le(G, h_0 / u_c), Ge(G, -h_0 / u_c), Eq(h_0, h_star), Gt(u_c, 0)),
        sp.And(Le(G, h_star / u_c), Ge(G, -h_star / u_c), Lt(u_a, L)),
        (Lt(u_a, L),),
    ),
    # special cases
    Case("a special case is not general", (Eq(h, f_c * u_a),), Eq(u_a, f_c * u_a), (Eq(f_c, 1),)),
    Case("for f_c = 0", (Eq(f_c * u_a, f_c * h_0), Eq(f_c, 0)), Eq(u_a, h_0), (Eq(f_c, 1),),
         without=(Eq(f_c, 0),)),
    Case("a variable of integration", (Eq(G, sp.Integral(sp.Abs(theta), (theta, -1, 1))),),
         Eq(G, 0), (), Eq(G, 1)),
    # integrals, limits of a parameter
    Case("rates of two orders", (Eq(du, T * acceleration(u_a)),), Eq(u_c, T * u_a),
         (START, Eq(rate("u_a").subs(t, 0), 0)), Eq(u_c, T * rate("u_a"))),
    Case("an inequality integrated", (Ge(du, f_c * rate("u_a")), START, Eq(initial("u_a"), 0)),
         Eq(u_c, f_c * u_a), (), Ge(u_c, f_c * u_a)),
    Case("a start bounded below", (Eq(du, f_c * rate("u_a")), Ge(initial("u_c"), h_0),
         Eq(initial("u_a"), 0)), Eq(u_c, h_0 + f_c * u_a), (), Ge(u_c, h_0 + f_c * u_a)),
    Case("slopes in a datum, starts in time", (Eq(initial("G"), 0), Eq(initial("G_inf"), 0)),
         Eq(G, G_inf), (Eq(rate("G"), rate("G_inf")),)),
    Case("strictness in a limit", tuple(Gt(h + h_0 / n, u_a) for n in (1, 10**6, 10**60)),
         Gt(h, u_a), (), Gt(h + h_0 / 10**5, u_a)),
    Case("a limit for f_c = 0", (), Eq(sp.Limit(f_c * N / (1 + f_c * N), N, sp.oo), 1),
         (Gt(f_c, 0),)),
    Case("a root of zero", (), Eq(sp.Limit(tau ** (1 / N), N, sp.oo), 1), (Gt(tau, 0),)),
    Case("a floor jumps", (), Eq(sp.Limit(sp.floor(2 - 1 / N), N, sp.oo), 2), (),
         Eq(sp.Limit(sp.floor(2 - 1 / N), N, sp.oo), 1)),
    Case("a limit at finite k", (Eq(R_a, k * b * L * (U_c - U)),), Eq(R_a, 0), (Eq(U_c, U),)),
    # divergence
    Case("a lower bound is no growth", (Ge(u_c, h_0),), GROWS, (Ge(u_c, C * t),)),
    Case("roughness of f_c < 0", (Ge(u_c, C * t),), Eq(forever(SIZE), sp.oo), (Gt(f_c, 0),)),
    Case("growth less growth", (Ge(u_c, C * t),), Eq(forever(u_c - C * t), sp.oo),
         (Ge(u_c, 2 * C * t),)),
    Case("a rate that fades", (Eq(du, C / (1 + t / T) ** 2),), GROWS, (Eq(du, C / (1 + t / T)),),
         without=(Eq(du, C / (1 + t / T) ** 2),)),
    Case("a load that grows", (Eq(du, C * exp(-U_a / h_star)),), GROWS, (BOUNDED,)),
    Case("positive is not bounded below", (Eq(du, C * sigma / h_star),), GROWS,
         (Ge(sigma, h_star),)),
    Case("a rate in two pieces", (Eq(du, sp.Piecewise((C, u_c < h_star), (C / (1 + t / T) ** 2, True))),),
         GROWS, (Eq(du, C),), without=(Eq(du, sp.Piecewise((C, u_c < h_star), (C / (1 + t / T) ** 2, True))),)),
    # limits in time
    Case("h held as if bounded", (GROWS,), Eq(forever(h / u_c), 0), (Le(sp.Abs(h), h_0),)),
    Case("a rate over its field", (GROWS,), Eq(forever(T * du / u_c), 0), (Le(sp.Abs(du), C),)),
    Case("a load has no limit", (GROWS,), Eq(forever(U_a + h_0**2 / u_c), U_a), (CONSTANT,),
         Eq(forever(h_0**2 / u_c), 0)),
    Case("a square unbounded", (GROWS, Gt(h_0, 0)), Eq(forever(u_c / (u_c + U_a**2 / h_0)), 1), (BOUNDED,)),
    Case("a squeeze that stays", (Le(G, h_0 / u_c), Ge(G, -h_0 / u_c), Gt(u_c, 0)),
         Eq(forever(G), 0), (GROWS,)),
    Case("zero times infinity", (Eq(forever(G), 0), GROWS, Gt(h_0, 0)),
         Eq(forever(u_c * G / (h_0 + u_c * G)), 1), (Eq(forever(u_c * G), sp.oo),),
         without=(Eq(forever(G), 0), GROWS)),
    Case("zero times infinity in an exponent", (Eq(forever(G), 0), GROWS, Gt(h_0, 0)),
         Eq(forever(exp(-u_c * G / h_0)), 1), (Eq(forever(u_c * G), 0),), without=(GROWS,)),
    Case("a limit bounded below", (Ge(forever(du), C),), Eq(forever(later(u_c) - u_c), C * T),
         (Eq(forever(du), C),)),
    Case("a second derivative", (Eq(forever(acceleration(u_c)), 0),), Eq(forever(later(u_c) - u_c), 0),
         (Eq(forever(du), 0),)),
    Case("a limit at the start", (Eq(sp.Limit(du, t, 0), C),), Eq(forever(later(u_c) - u_c), C * T),
         (Eq(forever(du), C),), without=(Eq(sp.Limit(du, t, 0), C),)),
    Case("a bound by infinity", (Gt(u_c, 0),), Eq(forever(U_a / u_c), 0), (GROWS, BOUNDED)),
    Case("a limit elsewhere", (Eq(sp.Limit(G, t, 0), theta), GROWS), Eq(forever(G + h_0 / u_c), theta),
         (Eq(forever(G), theta),), without=(Eq(sp.Limit(G, t, 0), theta),)),
    # bounds
    Case("a slope in a datum", (Eq(G, omega * T),), Ge(G, omega * T + omega * t),
         (Ge(rate("G"), omega), Eq(initial("G"), omega * T)), without=(Eq(G, omega * T),)),
    Case("a second derivative bounded", (Ge(acceleration(u_c), C / T), START), Ge(u_c, C * t / T),
         (Ge(du, C / T),), without=(Ge(acceleration(u_c), C / T),)),
    Case("a start bounded above", (Ge(du, C), Le(initial("u_c"), h_0)), Ge(u_c, h_0 + C * t),
         (Ge(initial("u_c"), h_0),), without=(Le(initial("u_c"), h_0),)),
    Case("slope one with a jump", (Ge(x_inf, theta),), Ge(_drop(x_inf), _drop(theta)), (), Ge(x_inf, theta)),
    Case("tan is not monotone", (Ge(x_inf, theta),), Ge(sp.tan(x_inf), sp.tan(theta)), (),
         Ge(sp.tanh(x_inf), sp.tanh(theta))),
    Case("a pole", (Ge(x_inf, theta),), Ge(-1 / x_inf, -1 / theta), (Gt(theta, 0),)),
    Case("a part of an or", (sp.Or(Lt(u_a, L), Gt(h, L), Gt(h_0, L)),), sp.Or(Lt(u_a, L), Gt(h, L)),
         (Le(h_0, L),)),
    Case("the converse", (sp.Implies(Gt(u_a, L), Lt(h, L)),), sp.Implies(Lt(h, L), Gt(u_a, L)), (),
         sp.Implies(Ge(h, L), Le(u_a, L))),
    Case("slopes of any law", (), Le(*_softer), (), Le(_phi(-q), _phi(-2 * q))),
    # bounds and drift
    Case("a jump where nobody looks", (Ge(x_inf, theta),), Le(_jump(x_inf), _jump(theta)), (),
         Ge(_jump(x_inf), _jump(theta))),
    Case("a mean from the caller", (Eq(REMAINDER, 0),), Eq(LOGARITHM, h_0), (PERIODIC, MEAN),
         Eq(LOGARITHM, U_mean)),
    Case("a mean of no period", (Eq(REMAINDER, 0), BOUNDED, MEAN), Eq(LOGARITHM, U_mean), (PERIODIC,)),
    Case("an approach under any load",
         (Eq(du, C * exp(-GAP / (sigma_c0 + q * u_c))), START),
         Eq(forever(t * (du - C * exp(-1 / q)) - (sigma_c0 / q - h_0 + U_a) / q), 0), (BOUNDED,)),
    Case("a roughness like a root",
         (Eq(du, C * exp(-q + U_a / _size)), START, BOUNDED),
         Eq(forever(t * (du - C * exp(-q)) - U_a * _size / h_star), 0), (),
         Eq(forever(du), C * exp(-q))),
    Case("a zero of no function", (), Eq(u_stop, h_star),
         (Eq(U_max + 3 * f_c * u_stop - h_0 + 3 * sigma_c0 - u_stop, 0), Lt(f_c, sp.Rational(1, 3))),
         Eq(u_stop, (U_max - h_0 + 3 * sigma_c0) / (1 - 3 * f_c))),
    Case("a limit bounded above, in a drift", (Le(REMAINDER, 0), PERIODIC, MEAN), Eq(LOGARITHM, U_mean),
         (Eq(REMAINDER, 0),), without=(Le(REMAINDER, 0),)),
    # data and signs
    Case("theta has f_c", (Eq(u_cum, M * (1 + theta) / 2), Eq(theta, sp.tanh(4 - 2 / f_c))),
         Eq(slope(u_cum, f_c), 0), (), Eq(slope(u_cum, f_c), M * (1 - theta**2) / f_c**2)),
    Case("a bound has no slope", (Ge(u_cum, M * f_c),), Eq(slope(u_cum, f_c), M), (Eq(u_cum, M * f_c),)),
    Case("a branch of asin", (Eq(kappa, 1 + sp.sin(omega * T)),), Eq(T, sp.asin(kappa - 1) / omega),
         (Le(omega * T, sp.pi / 2),)),
    Case("a branch of asin, any real", (Eq(kappa, 1 + sp.sin(f_c)),), Eq(f_c, sp.asin(kappa - 1)),
         (Le(sp.Abs(f_c), sp.pi / 2),)),
    Case("any real is not positive", (), Gt(U_max, 0), (Gt(U_max, h_0),)),
    Case("any real is not above -1", (), Gt(f_c, -1), (Ge(f_c, 0),)),
    Case("any pressure", (), Lt(p, 10**6 * p_max), (Lt(p, p_max),)),
    # identities
    Case("a modulus", (), Eq(sp.Abs(f_c), f_c), (Ge(f_c, 0),)),
    Case("a logarithm of a square", (), Eq(log(x_inf**2), 2 * log(x_inf)), (Gt(x_inf, 0),)),
    Case("Lambert's branch", (), Eq(sp.LambertW(theta * exp(theta)), theta), (Ge(theta, -1),)),
    Case("a branch of atan", (), Eq(sp.atan(sp.tan(theta)), theta), (Lt(sp.Abs(theta), sp.pi / 2),)),
    Case("0/0 at f_c = 1", (), Eq((f_c**2 - 1) / (f_c - 1), f_c + 1), (Ne(f_c, 1),)),
    Case("zero is not one", (), sp.false, (), sp.true),
    Case("an inequality in a logarithm", (Ge(kappa, exp(f_c)),), Eq(log(kappa), f_c), (),
         Ge(log(kappa), f_c)),
    Case("at most is not equal", (Le(u_a, h_0),), Eq(u_a, h_0), (Ge(u_a, h_0),)),
    Case("0/0 for h = u_a", (Eq(u_c, h_0 + h - u_a),), Eq((h - u_a) / (u_c - h_0), 1), (Ne(h, u_a),)),
    # solutions
    Case("the load varies", (Eq(du, V * U_a / h_star), START), Eq(t, u_c * h_star / (V * U_a)),
         (CONSTANT, Gt(U_a, 0))),
    Case("Lambert, main branch", (Eq(tau, theta * exp(-theta)),), Eq(theta, -sp.LambertW(-tau)),
         (Le(theta, 1),)),
    Case("Lambert, other branch", (Eq(tau, theta * exp(-theta)), Gt(tau, 0)), Eq(theta, -sp.LambertW(-tau, -1), evaluate=False),
         (Ge(theta, 1),)),
    Case("twice the rate", (Eq(2 * du, C), START), Eq(t, u_c / C), (Eq(du, C),), without=(Eq(2 * du, C),)),
    Case("a rate bounded below", (Ge(du, C), START), Eq(t, u_c / C), (), Le(t, u_c / C)),
    # logic
    Case("at most and below", (), sp.Equivalent(Le(u_a, h_0), Lt(u_a, h_0)), (Ne(u_a, h_0),)),
    Case("a threshold for negative f_c", (SMALL,), sp.Equivalent(Gt(SHARE, epsilon), Gt(f_c, THRESHOLD)),
         (Gt(f_c, 0),)),
    Case("a threshold reached", (SMALL, Gt(f_c, 0)), sp.Equivalent(Gt(SHARE, epsilon), Ge(f_c, THRESHOLD)), (),
         sp.Equivalent(Gt(SHARE, epsilon), Gt(f_c, THRESHOLD))),
    # what is claimed of what
    Case("any load is a sine", (TAIL, START, LARGEST, PERIODIC, BOUNDED), Eq(u_c.subs(t, T), ROUNDS), (SINE,)),
    Case("a length is no drift", _constants, Eq(L, _c_1), (Eq(L, _c_1),)),
    Case("an area is no oscillation", (*_constants, Eq(rho, f_c * u_cum)),
         Eq(c_2, -(1 - theta) * U * rho * sp.cos(2 * sp.pi * tau) / sp.pi),
         (Eq(c_2, -(1 - theta) * U * rho * sp.cos(2 * sp.pi * tau) / sp.pi),)),
    Case("wear of the other solid", (TAIL, START, LARGEST, SINE), Eq(u_a.subs(t, T), ROUNDS), (Eq(u_a, u_c),)),
    Case("a slope is no logarithm", (Lt(f_c, 0),), Eq(f_a, 4 / f_c - 8), (Eq(f_a, 4 / f_c - 8),)),
    Case("a length is no slow time", _constants, Eq(L, m - _c_1 * log(m / rho)), (Eq(L, m - _c_1 * log(m / rho)),)),
    Case("the rate of another field", (Eq(rate("u_a"), C * p / p_max), Eq(p, p_max * exp(-u_c / h_star)), START),
         Eq(t, h_star / C * (p_max / p - 1)), (Eq(du, C * p / p_max),)),
    Case("theta is no rate", (Eq(mu, M / sigma_c0),), Eq(theta, mu), (Eq(theta, mu),)),
    # by hand
    Case("a condition forgotten", (), Eq(T * rate("U_a"), 0), (CONSTANT,)),
    # in the chain of the project
    Case("saturation as an equation", _saturating, _level, (Gt(h_star, 0),),
         Eq(forever(_level.lhs - _level.rhs), 0)),
    Case("wear at one third, anywhere", (), Eq(u_cum, FAST * T * (1 - sp.tanh(2)) / 2), (Eq(u_cum, FAST * T * (1 - sp.tanh(2)) / 2),)),
    Case("a drift with no period", (RATE, START, Gt(f_c, 0), BOUNDED, MEAN),
         Eq(forever((u_c - STEADY * t) / log(t / T)), DRIFT), (PERIODIC,)),
    Case("the highest ratio, u_c < 0", (Gt(f_c, 0), BOUNDED), Le(GAP / SIZE, _below), (Ge(u_c, 0),)),
    Case("the deviation, sigma < 0", (Gt(f_c, 0), BOUNDED),
         Le(sp.Abs((sigma_c0 / f_c - h_0 + U_a) / SIZE), (sigma_c0 / f_c + h_0 + U) / SIZE), (Ge(u_c, 0),)),
    Case("(13) for any pin", (*FULL_MODEL, Eq(k * U_c, p)), RATE, (Eq(U_c, 0), Eq(u_a, 0), Eq(sigma_a, 0)),
         without=(Eq(k * U_c, p), *FULL_MODEL[3:4], *FULL_MODEL[5:6], *FULL_MODEL[8:10])),
    Case("the smooth solution for any f_c", (RATE, START, CONSTANT), Eq(t, _smooth_time / (FAST / 2)), (Eq(f_c, 0),)),
    Case("the tail as an equation", (RATE, START, SINE, Eq(f_c, 0), LARGEST), Eq(u_c.subs(t, T), ROUNDS), (),
         Le(u_c.subs(t, T), ROUNDS)),
    Case("a slope at the start", (LAW, GROWN, Ge(u_c, 0)), _odds_form, (Gt(u_c, 0), Ne(h, 0))),
    Case("a roughness at the limit", (LAW, GROWN, Eq(h, GAP), Ne(f_c, 0)),
         Eq(sigma, (4 * U_a + 4 * sigma_c0 / f_c - 4 * h_0) / (ODDS - 8 + 4 / f_c)),
         (Ne(U_a, h_0 - sigma_c0 / f_c),)),
)  # fmt: skip
