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
  exists (Rmax 0 t0); intros t [M1 M2]%Rmax_Rlt.
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
  pose proof (is_lim_comp_continuous _ B p_infty 0 Z HB) as V; rewrite B0 in V.
  pose proof (is_lim_comp_continuous _ G p_infty 0 Z HG) as W; rewrite G0 in W.
  pose proof (is_lim_plus' _ _ _ _ _ W (bounded_vanishes a _ Ha V)) as P.
  rewrite Rplus_0_r in P; revert P; apply is_lim_ext_loc.
  destruct (proj1 (diverges_iff u) Hu 0) as [t0 H]; exists (Rmax 0 t0).
  intros t [M1 M2]%Rmax_Rlt; assert (0 < u t) by (apply H; lra).
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
  pose proof (is_lim_comp_continuous q G p_infty l Hq HG) as HGq; rewrite Gl in HGq.
  pose proof (tends_inv _ _ Hr0 (cesaro u r Hu Hr')) as Hut.
  pose proof (tends_mult _ _ _ _ Hut HGq) as Hp.
  pose proof (is_lim_minus' _ _ _ _ _ Hp (is_lim_const (/ r * d) _)) as Hz.
  rewrite Rminus_eq_0 in Hz; pose proof (bounded_vanishes a _ Ha Hz) as Hz'.
  pose proof (tends_mult _ _ _ _ Hp He) as Hw; rewrite Rmult_0_r in Hw.
  pose proof (is_lim_plus' _ _ _ _ _ Hz' Hw) as H; rewrite Rplus_0_r in H; revert H.
  assert (N : exists t0, forall t, t0 < t -> u t / t <> 0).
  { pose proof (cesaro u r Hu Hr') as C; rewrite tends_iff in C.
    destruct (C (Rabs r) (Rabs_pos_lt _ Hr0)) as [t0 Ht0]; exists t0; intros t Ht Z.
    specialize (Ht0 t Ht); rewrite Z, Rminus_0_l, Rabs_Ropp in Ht0; lra. }
  destruct N as [t0 N]; apply is_lim_ext_loc; exists (Rmax 0 t0); intros t [Ht M]%Rmax_Rlt.
  assert (Hn : u t / t <> 0) by (apply N; lra).
  assert (u t <> 0) by (intro Z; apply Hn; rewrite Z; field; lra).
  rewrite Hr, <- Hl by lra; rewrite E; field; repeat split; rewrite ?Hl; lra.
Qed.

(** ** The logarithm *)

Lemma logarithm_diverges T : 0 < T -> diverges (fun t => ln (t / T)).
Proof.
  intros HT; apply (is_lim_comp ln (fun t => t / T) p_infty p_infty p_infty is_lim_ln_p).
  - apply (tends_ext (fun t => 0 + / T * t)); [intros; field; lra |].
    apply diverges_affine; [apply Rinv_0_lt_compat; lra | apply is_lim_id].
  - exists 0; intros; discriminate.
Qed.

(** Cesaro on the logarithmic scale: [t v' -> m] gives [v / ln (t/T) -> m]. *)
Lemma logarithmic (v : R -> R) m T : 0 < T -> (forall t, 0 < t -> ex_derive v t) ->
  tends (fun t => t * Derive v t) m -> tends (fun t => v t / ln (t / T)) m.
Proof.
  intros HT Hv H; set (e := fun s => 0 + T * exp s); set (w := fun s => v (e s)).
  assert (Hw : forall s, is_derive w s (e s * Derive v (e s))).
  { intros s; apply (is_derive_comp v e s); [| unfold e; auto_derive; trivial; ring].
    apply Derive_correct, Hv; pose proof (exp_pos s); unfold e; nra. }
  assert (Hl : tends (fun s => w s / s) m).
  { apply cesaro; [intros s _; eexists; apply Hw |].
    apply tends_ext with (f := fun s => e s * Derive v (e s)).
    { intros s _; symmetry; apply is_derive_unique, Hw. }
    apply (is_lim_comp (fun t => t * Derive v t) e p_infty m p_infty H); [| exists 0; discriminate].
    apply diverges_affine; [assumption | apply is_lim_exp_p]. }
  pose proof (is_lim_comp _ _ p_infty m p_infty Hl (logarithm_diverges T HT)) as HC.
  eapply is_lim_ext_loc; [| apply HC; exists 0; intros; discriminate].
  exists 0; intros t Ht; unfold w, e; rewrite exp_ln by (apply Rdiv_lt_0_compat; assumption).
  do 2 f_equal; field; lra.
Qed.

(** A periodic, continuous function is bounded. *)
Lemma periodic_bounded F T : 0 < T -> (forall t, 0 <= t -> F (T + t) = F t) ->
  continuous_in_time F -> exists B, 0 < B /\ forall t, 0 <= t -> Rabs (F t) <= B.
Proof.
  intros HT Hp Hc.
  destruct (continuity_ab_maj (fun x => Rabs (F (Rabs x))) 0 T) as [top [Ht _]]; [lra | |].
  { intros x _; apply continuity_pt_filterlim.
    apply (continuous_comp (fun x => F (Rabs x)) Rabs); [apply Hc | apply continuous_Rabs]. }
  set (B := Rabs (F (Rabs top)) + 1).
  assert (N : forall n t, 0 <= t <= INR (Datatypes.S n) * T -> Rabs (F t) <= B).
  { assert (I : forall t, 0 <= t <= T -> Rabs (F t) <= B).
    { intros t Hn; specialize (Ht t Hn); rewrite (Rabs_pos_eq t) in Ht by lra; unfold B; lra. }
    induction n as [| n IH]; intros t Hn; [apply I; simpl in Hn; lra |].
    destruct (Rle_lt_dec t T) as [Hle | Hlt]; [apply I; lra |]; rewrite S_INR in Hn.
    replace t with (T + (t - T)) by ring; rewrite Hp by lra; apply IH; lra. }
  exists B; split; [unfold B; pose proof (Rabs_pos (F (Rabs top))); lra |].
  intros t Ht0; destruct (nfloor_ex (t / T)) as [n [_ Hn]].
  { apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat, HT]. }
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

(** [t (u' - r) - a(U) -> 0] with affine a and periodic, continuous U of mean m:
    [(u - r t) / ln (t/T) -> a(m)]. *)
Lemma logarithmic_drift (u U a : R -> R) (r m T : R) : 0 < T ->
  (forall t, 0 <= t -> ex_derive u t) -> continuous_in_time U ->
  (forall t, 0 <= t -> U (T + t) = U t) -> m = RInt U 0 T / T ->
  (forall x, a x = a 0 + (a 1 - a 0) * x) -> tends (fun t => t * (Derive u t - r) - a (U t)) 0 ->
  tends (fun t => (u t - r * t) / ln (t / T)) (a m).
Proof.
  intros HT Hu Hc Hp Hm Ha H; set (b := fun t => U (Rabs t) - m); set (A := fun t => RInt b 0 t).
  assert (Hb : forall t, continuous b t).
  { intros t; apply (continuous_minus (fun t => U (Rabs t))); [apply Hc | apply continuous_const]. }
  destruct (periodic_integral b T) as [B HB]; trivial.
  { intros t Ht; unfold b; rewrite !Rabs_pos_eq, Hp by lra; trivial. }
  { unfold b; rewrite (RInt_minus (fun t => U (Rabs t)) (fun _ => m)), RInt_const, (RInt_ext _ U).
    - rewrite Hm; unfold minus, plus, opp, scal; simpl; unfold mult; simpl; field; lra.
    - intros x Hx; rewrite Rmin_left in Hx by lra; rewrite Rabs_pos_eq; lra.
    - apply (integrable (fun t => U (Rabs t))), Hc.
    - apply ex_RInt_const. }
  assert (HA : forall t, is_derive A t (b t)) by (intros; apply derive_integral, Hb).
  pose proof (tends_inv_diverges _ (is_lim_id p_infty)) as Hq.
  apply (bounded_vanishes A), (tends_scal (a 1 - a 0)) in Hq; [| exists B; exact HB].
  rewrite Rmult_0_r in Hq; set (v := fun t => u t - r * t - (a 1 - a 0) * (/ t * A t)).
  assert (Hv : forall t, 0 < t ->
    is_derive v t (Derive u t - r - (a 1 - a 0) * ((b t * t - A t) / t ^ 2))).
  { intros t Ht; unfold v; auto_derive.
    - repeat split; [apply Hu | | eexists; apply HA]; lra.
    - change (fun x => A x) with A; rewrite (is_derive_unique _ _ _ (HA t)).
      change (fun x => u x) with u; field; lra. }
  assert (L : tends (fun t => v t / ln (t / T)) (a m)).
  { apply logarithmic; [assumption | intros t Ht; eexists; apply Hv, Ht |].
    pose proof (is_lim_plus' _ _ _ _ _ (is_lim_plus' _ _ _ _ _ H Hq) (is_lim_const (a m) _)) as G.
    rewrite !Rplus_0_l in G; revert G; apply is_lim_ext_loc; exists 0; intros t Ht.
    rewrite (is_derive_unique _ _ _ (Hv t Ht)), (Ha (U t)), (Ha m); unfold b.
    rewrite Rabs_pos_eq by lra; field; lra. }
  pose proof (tends_inv_diverges _ (logarithm_diverges T HT)) as Hi.
  pose proof (is_lim_plus' _ _ _ _ _ L (tends_mult _ _ _ _ Hq Hi)) as G.
  rewrite Rmult_0_r, Rplus_0_r in G; revert G; apply tends_ext; intros t _; unfold v, Rdiv; ring.
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
    pose proof (is_lim_plus' _ _ _ _ _ (is_lim_const s _) (tends_mult _ _ _ _
      (is_lim_plus' _ _ _ _ _ Hs (is_lim_const b _)) Hi)) as G.
    replace (s + (0 + b) * 0) with s in G by ring; revert G; apply is_lim_ext_loc.
    exists 0; intros t Ht; field; lra. }
  subst s; apply Hm, (tends_unique (fun t => (u t - r * t) / ln (t / T))); [assumption |].
  pose proof (tends_mult _ _ _ _ (is_lim_plus' _ _ _ _ _ Hs (is_lim_const b _))
    (tends_inv_diverges _ (logarithm_diverges T HT))) as G.
  replace ((0 + b) * 0) with 0 in G by ring; revert G; apply tends_ext; intros t Ht.
  unfold Rdiv; f_equal; ring.
Qed.
