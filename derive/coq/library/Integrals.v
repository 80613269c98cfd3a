(** Integrals of continuous functions: separated variables, and integration by parts. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Wear Require Import Limits.
Open Scope R_scope.

(** A half-line, with its end or without, or all reals. *)
Definition upwards (P : R -> Prop) := forall x y, P x -> x <= y -> P y.

Lemma between P a b z : upwards P -> P a -> P b -> Rmin a b <= z -> P z.
Proof. intros U Ha Hb; apply U; unfold Rmin; destruct (Rle_dec a b); assumption. Qed.

Lemma integrable (g : R -> R) P a b : upwards P -> (forall s, P s -> continuous g s) ->
  P a -> P b -> ex_RInt g a b.
Proof.
  intros U Hg Ha Hb; apply (ex_RInt_continuous g); intros z [Hz _].
  apply Hg, (between P a b); assumption.
Qed.

Lemma derive_integral (g : R -> R) P a x : upwards P -> (forall s, P s -> continuous g s) ->
  P a -> locally x P -> is_derive (fun x => RInt g a x) x (g x).
Proof.
  intros U Hg Ha Hx; apply (is_derive_RInt g _ a); [| apply Hg, (locally_singleton _ _ Hx)].
  revert Hx; apply filter_imp; intros z Hz.
  apply (RInt_correct g), (integrable g P); assumption.
Qed.

(** Separated variables: [g(y) y' = c] at every time. *)
Lemma separates (y g : R -> R) (c : R) (low : Rbar) : (forall t, 0 <= t -> ex_derive y t) ->
  (forall t, 0 <= t -> Rbar_lt low (y t)) -> (forall s : R, Rbar_lt low s -> continuous g s) ->
  (forall t, 0 <= t -> g (y t) * Derive y t = c) -> forall t, 0 <= t -> c * t = RInt g (y 0) (y t).
Proof.
  intros Hy Hl Hg E t Ht; set (G := fun t => RInt g (y 0) (y t)).
  assert (D : forall s, 0 <= s -> is_derive G s c).
  { intros s Hs; rewrite <- (E s Hs), Rmult_comm.
    apply (is_derive_comp (RInt g (y 0)) y s); [| apply Derive_correct; auto].
    apply (derive_integral g (fun x => Rbar_lt low x)); [exact (fun x y => Rbar_lt_le_trans low x y) | auto | apply Hl; lra |].
    apply (locally_interval _ _ low p_infty); [auto | exact I | trivial]. }
  change (c * t = G t); rewrite (integrates G (fun t => t) c) with (t := t); trivial.
  - unfold G; rewrite RInt_point; unfold zero; simpl; ring.
  - intros s Hs; eexists; apply D, Hs.
  - intros; auto_derive; trivial.
  - intros s Hs; rewrite Derive_id, Rmult_1_r; apply is_derive_unique, D, Hs.
Qed.

(** By a primitive of a part of the integrand: [F' = g - r]. *)
Lemma by_parts (F g r : R -> R) (low : Rbar) (a b : R) : Rbar_lt low a -> Rbar_lt low b ->
  (forall s : R, Rbar_lt low s -> is_derive F s (g s - r s)) ->
  (forall s : R, Rbar_lt low s -> continuous g s) ->
  (forall s : R, Rbar_lt low s -> continuous r s) -> RInt g a b = F b - F a + RInt r a b.
Proof.
  intros Ha Hb D Hg Hr; pose proof (fun x y : R => Rbar_lt_le_trans low x y) as U.
  pose proof (integrable g (fun x => Rbar_lt low x) a b U Hg Ha Hb) as Ig.
  pose proof (integrable r (fun x => Rbar_lt low x) a b U Hr Ha Hb) as Ir.
  pose proof (RInt_minus g r a b Ig Ir : RInt (fun s => g s - r s) a b = RInt g a b - RInt r a b).
  assert (RInt (fun s => g s - r s) a b = F b - F a); [| lra].
  apply is_RInt_unique, (is_RInt_derive F); intros z [Hz _];
    apply (between (fun x => Rbar_lt low x) a b z U Ha Hb) in Hz; [auto |].
  apply (continuous_minus g r); auto.
Qed.

Lemma RInt_zero (a b : R) : RInt (fun _ => 0) a b = 0.
Proof. rewrite (RInt_const a b 0); apply Rmult_0_r. Qed.
