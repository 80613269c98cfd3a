(** How the rate approaches its limit, and what that adds to the wear: the logarithmic drift. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Wear Require Import Limits Integrals.
Open Scope R_scope.

(** ** The rate to first order in 1/t *)

(** What is bounded times what tends to 0. *)
Lemma bounded_vanishes a e : bounded a -> tends e 0 -> tends (fun t => e t * a t) 0.
Proof.
  rewrite !tends_iff; intros [B Ha] He eps Hep.
  assert (HB : 0 <= B) by (pose proof (Rabs_pos (a 0)); pose proof (Ha 0); lra).
  destruct (He (eps / (B + 1))) as [t0 Ht0]; [apply Rdiv_lt_0_compat; lra |].
  exists (Rmax 0 t0); intros t Ht; pose proof (Rmax_l 0 t0); pose proof (Rmax_r 0 t0).
  assert (Hs : Rabs (e t - 0) < eps / (B + 1)) by (apply Ht0; lra).
  apply Rlt_div_r in Hs; [| lra]; rewrite Rminus_0_r, Rabs_mult in *.
  pose proof (Ha t); pose proof (Rabs_pos (e t)); nra.
Qed.

(** What is, for u > 0, [u A(1/u) + a B(1/u)] with bounded a, with A(0) = 0 and B(0) = 0, where
    u -> oo: it tends to A'(0). *)
Lemma at_infinity (u a A B f : R -> R) (l : R) : diverges u ->
  bounded a -> is_derive A 0 l -> A 0 = 0 -> continuous B 0 ->
  B 0 = 0 -> (forall t, 0 <= t -> 0 < u t -> f t = u t * A (/ u t) + a t * B (/ u t)) -> tends f l.
Proof.
  intros Hu Ha HA A0 HB B0 Hf; pose proof (tends_inv_diverges _ Hu) as Z.
  destruct (chord A 0 l HA) as [G [HG [G0 E]]].
  pose proof (passes _ B 0 Z HB) as V; rewrite B0 in V.
  pose proof (passes _ G 0 Z HG) as W; rewrite G0 in W.
  pose proof (tends_plus _ _ _ _ W (bounded_vanishes a _ Ha V)) as P.
  rewrite Rplus_0_r in P; revert P; apply is_lim_ext_loc.
  destruct (proj1 (diverges_iff u) Hu 0) as [t0 H]; exists (Rmax 0 t0); intros t Ht.
  pose proof (Rmax_l 0 t0); pose proof (Rmax_r 0 t0); assert (0 < u t) by (apply H; lra).
  specialize (E (/ u t)); rewrite A0, !Rminus_0_r in E; rewrite Hf, E by lra; field; lra.
Qed.

(** [u' = F(q)], [u (q - l) - a -> 0] with bounded a, [q -> l] and [u' -> r]:
    [t (u' - r) - F'(l) a / r -> 0]. *)
Lemma first_order (u q a F : R -> R) (l d r : R) :
  (forall t, 0 <= t -> ex_derive u t) -> (forall t, 0 <= t -> Derive u t = F (q t)) ->
  is_derive F l d -> F l = r -> r <> 0 -> bounded a ->
  tends q l -> tends (Derive u) r -> tends (fun t => u t * (q t - l) - a t) 0 ->
  tends (fun t => t * (Derive u t - r) - d / r * a t) 0.
Proof.
  intros Hu Hr Hd Hl Hr0 Ha Hq Hr' He; destruct (chord F l d Hd) as [G [HG [Gl E]]].
  pose proof (passes q G l Hq HG) as HGq; rewrite Gl in HGq.
  pose proof (tends_inv _ _ Hr0 (cesaro u r Hu Hr')) as Hut.
  pose proof (tends_mult _ _ _ _ Hut HGq) as Hp.
  pose proof (tends_minus _ _ _ _ Hp (tends_const (/ r * d))) as Hz; rewrite Rminus_eq_0 in Hz.
  pose proof (bounded_vanishes a _ Ha Hz) as Hz'.
  pose proof (tends_mult _ _ _ _ Hp He) as Hw; rewrite Rmult_0_r in Hw.
  pose proof (tends_plus _ _ _ _ Hz' Hw) as H; rewrite Rplus_0_r in H; revert H.
  assert (N : exists t0, forall t, t0 < t -> u t / t <> 0).
  { pose proof (cesaro u r Hu Hr') as C; rewrite tends_iff in C.
    destruct (C (Rabs r) (Rabs_pos_lt _ Hr0)) as [t0 Ht0]; exists t0; intros t Ht Z.
    specialize (Ht0 t Ht); rewrite Z, Rminus_0_l, Rabs_Ropp in Ht0; lra. }
  destruct N as [t0 N]; apply is_lim_ext_loc; exists (Rmax 0 t0); intros t Ht.
  pose proof (Rmax_l 0 t0); pose proof (Rmax_r 0 t0).
  assert (Hn : u t / t <> 0) by (apply N; lra).
  assert (u t <> 0) by (intro Z; apply Hn; rewrite Z; field; lra).
  rewrite Hr, <- Hl by lra; rewrite E; field; repeat split; rewrite ?Hl; lra.
Qed.

(** ** The logarithm *)

(** Cesaro on the logarithmic scale: [t v' -> m] gives [v / ln t -> m]. *)
Lemma logarithmic (v : R -> R) m : (forall t, 1 <= t -> ex_derive v t) ->
  tends (fun t => t * Derive v t) m -> tends (fun t => v t / ln t) m.
Proof.
  intros Hv H; set (w := fun s => v (exp s)).
  assert (Hw : forall s, 0 <= s -> is_derive w s (exp s * Derive v (exp s))).
  { intros s Hs; unfold w; apply (is_derive_comp v exp s); [| apply is_derive_exp].
    apply Derive_correct, Hv; rewrite <- exp_0; destruct Hs as [Hs | <-];
      [left; apply exp_increasing; assumption | right; reflexivity]. }
  assert (Hl : tends (fun s => w s / s) m).
  { apply cesaro; [intros s Hs; eexists; apply Hw, Hs |].
    apply tends_ext with (f := fun s => exp s * Derive v (exp s)).
    { intros s Hs; symmetry; apply is_derive_unique, Hw, Hs. }
    apply (is_lim_comp (fun t => t * Derive v t) exp p_infty m p_infty H is_lim_exp_p).
    exists 0; intros; discriminate. }
  pose proof (is_lim_comp _ ln p_infty m p_infty Hl is_lim_ln_p) as HC.
  eapply is_lim_ext_loc; [| apply HC; exists 0; intros; discriminate].
  exists 1; intros t Ht; unfold w; rewrite exp_ln by lra; reflexivity.
Qed.

(** A periodic, continuous function is bounded. *)
Lemma periodic_bounded F T : 0 < T -> (forall t, 0 <= t -> F (T + t) = F t) ->
  continuous_in_time F -> exists B, 0 < B /\ forall t, 0 <= t -> Rabs (F t) <= B.
Proof.
  intros HT Hp Hc.
  destruct (continuity_ab_maj (fun x => Rabs (F (Rabs x))) 0 T) as [top [Ht _]]; [lra | |].
  { intros x _; apply continuity_pt_filterlim.
    apply (continuous_comp (fun x => F (Rabs x)) Rabs); [apply Hc | apply continuous_Rabs]. }
  set (B := Rabs (F (Rabs top))) in *.
  assert (N : forall n t, 0 <= t <= INR (Datatypes.S n) * T -> Rabs (F t) <= B).
  { assert (I : forall t, 0 <= t <= T -> Rabs (F t) <= B).
    { intros t Hn; specialize (Ht t Hn); rewrite (Rabs_pos_eq t) in Ht; tauto. }
    induction n as [| n IH]; intros t Hn; [apply I; simpl in Hn; lra |].
    destruct (Rle_lt_dec t T) as [Hle | Hlt]; [apply I; lra |]; rewrite S_INR in Hn.
    replace t with (T + (t - T)) by ring; rewrite Hp by lra; apply IH; lra. }
  exists (B + 1); split; [unfold B; pose proof (Rabs_pos (F (Rabs top))); lra |].
  intros t Ht0; destruct (nfloor_ex (t / T)) as [n [_ Hn]].
  { apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat, HT]. }
  apply Rle_trans with B; [| lra].
  apply (N n); split; [assumption |]; rewrite S_INR; apply Rlt_div_l in Hn; lra.
Qed.

(** A periodic, continuous function with integral 0 over a period has a bounded integral. *)
Lemma periodic_integral a T : 0 < T -> (forall t, 0 <= t -> a (T + t) = a t) ->
  (forall t, continuous a t) -> RInt a 0 T = 0 ->
  exists B, forall t, 0 <= t -> Rabs (RInt a 0 t) <= B.
Proof.
  intros HT Hp Hc H0.
  assert (I : forall x y, ex_RInt a x y) by (intros; apply integrable, Hc).
  assert (S : forall t, 0 <= t -> RInt a 0 (t + T) = RInt a 0 t).
  { intros t Ht; rewrite <- (RInt_Chasles a 0 T (t + T)) by apply I.
    rewrite H0; unfold plus; simpl; rewrite Rplus_0_l.
    assert (L : RInt (fun x => scal 1 (a (1 * x + T))) 0 t = RInt a T (t + T)).
    { transitivity (RInt a (1 * 0 + T) (1 * t + T)); [apply (RInt_comp_lin a 1 T 0 t), I |].
      f_equal; ring. }
    rewrite <- L; apply RInt_ext; intros x Hx; unfold scal; simpl; unfold mult; simpl.
    rewrite !Rmult_1_l, Rplus_comm; apply Hp.
    revert Hx; unfold Rmin; destruct (Rle_dec 0 t); lra. }
  destruct (periodic_bounded (fun t => RInt a 0 t) T) as [B [_ HB]]; [assumption | | |].
  - intros t Ht; rewrite Rplus_comm; apply S, Ht.
  - apply smooth_in_time; intros t _; eexists; apply derive_integral, Hc.
  - exists B; exact HB.
Qed.

(** [t (u' - r) - c0 - c1 U -> 0] with periodic, continuous U of mean m:
    [(u - r t) / ln (t/T) -> c0 + c1 m]. *)
Lemma logarithmic_drift (u U : R -> R) (r c0 c1 m T : R) : 0 < T ->
  (forall t, 0 <= t -> ex_derive u t) -> continuous_in_time U ->
  (forall t, 0 <= t -> U (T + t) = U t) -> RInt U 0 T = m * T ->
  tends (fun t => t * (Derive u t - r) - (c0 + c1 * U t)) 0 ->
  tends (fun t => (u t - r * t) / ln (t / T)) (c0 + c1 * m).
Proof.
  intros HT Hu Hc Hp Hm H; set (b := fun t => U (Rabs t) - m); set (A := fun t => RInt b 0 t).
  assert (Hb : forall t, continuous b t).
  { intros t; apply (continuous_minus (fun t => U (Rabs t))); [apply Hc | apply continuous_const]. }
  destruct (periodic_integral b T) as [B HB]; trivial.
  { intros t Ht; unfold b; rewrite !Rabs_pos_eq, Hp by lra; trivial. }
  { unfold b; rewrite (RInt_minus (fun t => U (Rabs t)) (fun _ => m)), RInt_const, (RInt_ext _ U), Hm.
    - unfold minus, plus, opp, scal; simpl; unfold mult; simpl; ring.
    - intros x Hx; rewrite Rmin_left in Hx by lra; rewrite Rabs_pos_eq; lra.
    - apply (integrable (fun t => U (Rabs t))), Hc.
    - apply ex_RInt_const. }
  assert (HA : forall t, is_derive A t (b t)) by (intros; apply derive_integral, Hb).
  assert (Hq : tends (fun t => A t / t) 0).
  { apply squeezed with (s := fun t => t) (B := B); [apply is_lim_id |]; intros t Ht.
    assert (P : 0 < / t) by (apply Rinv_0_lt_compat, Ht).
    pose proof (HB t (Rlt_le _ _ Ht)) as Q; apply Rabs_le_between in Q; fold (A t) in Q.
    unfold Rdiv; nra. }
  apply (tends_scal c1) in Hq; rewrite Rmult_0_r in Hq.
  set (v := fun t => u t - r * t - c1 * (A t / t)).
  assert (Hv : forall t, 0 < t ->
    is_derive v t (Derive u t - r - c1 * ((b t * t - A t) / t ^ 2))).
  { intros t Ht; apply (is_derive_minus (fun t => u t - r * t) (fun t => c1 * (A t / t))).
    - apply (is_derive_minus u (fun t => r * t)); [apply Derive_correct, Hu; lra |].
      auto_derive; [trivial | ring].
    - apply is_derive_scal; evar_last;
        [apply (is_derive_div A (fun t => t) t (b t) 1); [auto | apply (is_derive_id t) | lra] |].
      unfold Rdiv; ring. }
  assert (L : tends (fun t => v t / ln t) (c0 + c1 * m)).
  { apply logarithmic; [intros t Ht; eexists; apply Hv; lra |].
    pose proof (tends_plus _ _ _ _ (tends_plus _ _ _ _ H Hq) (tends_const (c0 + c1 * m))) as G.
    replace (0 + 0 + (c0 + c1 * m)) with (c0 + c1 * m) in G by ring; revert G.
    apply is_lim_ext_loc; exists 0.
    intros t Ht; rewrite (is_derive_unique _ _ _ (Hv t Ht)); unfold b; rewrite Rabs_pos_eq by lra; field; lra. }
  pose proof is_lim_ln_p as Hln; fold (diverges ln) in Hln.
  pose proof (tends_inv_diverges ln Hln) as Hi.
  pose proof (tends_plus _ _ _ _ L (tends_mult _ _ _ _ Hq Hi)) as G1.
  pose proof (tends_minus _ _ _ _ (tends_const 1) (tends_scal (ln T) _ _ Hi)) as G2.
  replace (1 - ln T * 0) with 1 in G2 by ring; apply tends_inv in G2; [| lra].
  pose proof (tends_mult _ _ _ _ G1 G2) as G.
  replace ((c0 + c1 * m + 0 * 0) * / 1) with (c0 + c1 * m) in G by field; revert G.
  apply is_lim_ext_loc.
  exists (Rmax 1 T); intros t Ht; pose proof (Rmax_l 1 T); pose proof (Rmax_r 1 T).
  assert (0 < ln t) by (rewrite <- ln_1; apply ln_increasing; lra).
  assert (ln T < ln t) by (apply ln_increasing; lra).
  unfold v; rewrite ln_div by lra; field; repeat split; lra.
Qed.

(** The same, where what is added is affine in U, by a function a. *)
Lemma drift_by_mean (u U a : R -> R) (r m T : R) : 0 < T ->
  (forall t, 0 <= t -> ex_derive u t) -> continuous_in_time U ->
  (forall t, 0 <= t -> U (T + t) = U t) -> m = RInt U 0 T / T ->
  (forall x, a x = a 0 + (a 1 - a 0) * x) -> tends (fun t => t * (Derive u t - r) - a (U t)) 0 ->
  tends (fun t => (u t - r * t) / ln (t / T)) (a m).
Proof.
  intros HT Hu Hc Hp Hm Ha H; rewrite (Ha m); apply logarithmic_drift with U; trivial.
  - rewrite Hm; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra.
  - revert H; apply tends_ext; intros t Ht; rewrite (Ha (U t)); reflexivity.
Qed.

(** Then u has no affine asymptote, unless m = 0. *)
Lemma no_asymptote (u : R -> R) (r m T b s : R) : 0 < T -> m <> 0 ->
  tends (fun t => (u t - r * t) / ln (t / T)) m -> tends (fun t => u t / t) r ->
  ~ tends (fun t => u t - (s * t + b)) 0.
Proof.
  intros HT Hm H Hr Hs.
  pose proof (tends_inv_diverges (fun t => t) (is_lim_id p_infty)) as Hi.
  assert (E : s = r).
  { apply (tends_unique (fun t => u t / t)); [| assumption].
    pose proof (tends_plus _ _ _ _ (tends_const s) (tends_mult _ _ _ _
      (tends_plus _ _ _ _ Hs (tends_const b)) Hi)) as G.
    replace (s + (0 + b) * 0) with s in G by ring; revert G; apply is_lim_ext_loc.
    exists 0; intros t Ht; field; lra. }
  subst s; apply Hm, (tends_unique (fun t => (u t - r * t) / ln (t / T))); [assumption |].
  assert (Hl : diverges (fun t => ln (t / T))).
  { apply (is_lim_comp ln (fun t => t / T) p_infty p_infty p_infty is_lim_ln_p).
    - apply (diverges_ext (fun t => 0 + / T * t)); [intros; field; lra |].
      apply diverges_affine; [apply Rinv_0_lt_compat; lra | apply is_lim_id].
    - exists 0; intros; discriminate. }
  pose proof (tends_mult _ _ _ _ (tends_plus _ _ _ _ Hs (tends_const b))
    (tends_inv_diverges _ Hl)) as G.
  replace ((0 + b) * 0) with 0 in G by ring; revert G; apply tends_ext; intros t Ht.
  unfold Rdiv; f_equal; ring.
Qed.
