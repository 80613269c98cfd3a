(** The hyperbolic tangent, by its exponential; its sign, slope, bounds and order. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(** The stable form: [tanh x = 1 - 2 / (1 + e^(2x))]. *)
Lemma tanh_exp (x : R) : tanh x = 1 - 2 / (exp (2 * x) + 1).
Proof.
  replace (2 * x) with (x + x) by ring; unfold tanh, sinh, cosh.
  rewrite exp_plus, exp_Ropp; pose proof (exp_pos x); field; nra.
Qed.

Lemma tanh_opp (x : R) : tanh (- x) = - tanh x.
Proof. unfold tanh, sinh, cosh; rewrite Ropp_involutive; pose proof (exp_pos x);
  pose proof (exp_pos (- x)); field; lra. Qed.

Lemma tanh_0 : tanh 0 = 0.
Proof. rewrite tanh_exp, Rmult_0_r, exp_0; lra. Qed.

Lemma tanh_below (x : R) : tanh x < 1.
Proof.
  rewrite tanh_exp; pose proof (exp_pos (2 * x)).
  assert (0 < 2 / (exp (2 * x) + 1)) by (apply Rdiv_lt_0_compat; lra); lra.
Qed.

Lemma tanh_above (x : R) : -1 < tanh x.
Proof. pose proof (tanh_below (- x)); rewrite tanh_opp in *; lra. Qed.

Lemma tanh_derive (x : R) : is_derive tanh x (1 - tanh x ^ 2).
Proof.
  apply is_derive_ext with (f := fun x => 1 - 2 / (exp (2 * x) + 1)).
  { intros; symmetry; apply tanh_exp. }
  pose proof (exp_pos (2 * x)).
  auto_derive; [lra |]. rewrite tanh_exp; field; lra.
Qed.

(** [auto_derive] knows tanh. *)
#[global] Instance tanh_differentiable : UnaryDiff tanh :=
  {| UnaryDiff_f' := fun x => 1 - tanh x ^ 2; UnaryDiff_H := tanh_derive |}.

Lemma tanh_continuous (x : R) : continuous tanh x.
Proof. apply (ex_derive_continuous tanh); eexists; apply tanh_derive. Qed.

Lemma tanh_increasing (x y : R) : x < y -> tanh x < tanh y.
Proof.
  intro; rewrite !tanh_exp; pose proof (exp_pos (2 * x)).
  assert (exp (2 * x) < exp (2 * y)) by (apply exp_increasing; lra).
  assert (/ (exp (2 * y) + 1) < / (exp (2 * x) + 1)) by (apply Rinv_lt_contravar; nra).
  unfold Rdiv; lra.
Qed.

Lemma tanh_order (x y : R) : x <= y -> tanh x <= tanh y.
Proof. intros [H | ->]; [left; apply tanh_increasing, H | right; reflexivity]. Qed.

(** The slope is at most 1: [tanh b - tanh a <= b - a]. *)
Lemma tanh_slope (a b : R) : a <= b -> tanh b - tanh a <= b - a.
Proof.
  intros H; assert (V : Rabs (tanh b - tanh a) <= 1 * Rabs (b - a)).
  { apply (bounded_variation tanh (fun x => 1 - tanh x ^ 2)); intros x _.
    pose proof (tanh_below x); pose proof (tanh_above x).
    split; [apply tanh_derive | apply Rabs_le; nra]. }
  rewrite (Rabs_pos_eq (b - a)) in V by lra; apply Rabs_le_between in V; lra.
Qed.

(** The share of the largest pressure: [(1 + tanh x)/2 = 1/(1 + e^(-2x))]. *)
Lemma share_exp (x : R) : (1 + tanh x) / 2 = / (1 + exp (- (2 * x))).
Proof. rewrite tanh_exp, exp_Ropp; pose proof (exp_pos (2 * x)); field; lra. Qed.

Lemma share_below_exp (x : R) : (1 + tanh x) / 2 < exp (2 * x).
Proof.
  rewrite share_exp, exp_Ropp; pose proof (exp_pos (2 * x)) as P; pose proof (Rinv_0_lt_compat _ P).
  apply (Rmult_lt_reg_r (1 + / exp (2 * x))); rewrite ?Rinv_l, ?Rmult_plus_distr_l, ?Rinv_r; lra.
Qed.
