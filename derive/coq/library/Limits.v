(** Limits for t -> oo: the theorems about time, each as its rule states it.

    A field is a function on R; what is assumed of it holds for every t >= 0. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Notation tends f l := (is_lim f p_infty (Finite l)).
Notation diverges f := (is_lim f p_infty p_infty).

(** The textbook's words. *)
Lemma tends_iff f l : tends f l <->
  forall eps, 0 < eps -> exists t0, forall t, t0 < t -> Rabs (f t - l) < eps.
Proof.
  rewrite <- is_lim_spec; split; intros H eps; [| exact (H eps (cond_pos eps))].
  intros He; exact (H (mkposreal eps He)).
Qed.

Lemma diverges_iff f : diverges f <-> forall m, exists t0, forall t, t0 < t -> m < f t.
Proof. rewrite <- is_lim_spec; simpl; reflexivity. Qed.

(** ** What holds from some time on *)

Lemma tends_ext f g (l : Rbar) : (forall t, 0 <= t -> f t = g t) ->
  is_lim f p_infty l -> is_lim g p_infty l.
Proof. intros E; apply is_lim_ext_loc; exists 0; intros t Ht; apply E; lra. Qed.

Lemma tends_value f l l' : l = l' -> tends f l -> tends f l'.
Proof. intros ->; trivial. Qed.

(** A limit is unique. *)
Lemma tends_unique f l l' : tends f l -> tends f l' -> l = l'.
Proof. intros H H'; apply is_lim_unique in H; apply is_lim_unique in H'; congruence. Qed.

(** ** Passage to the limit *)

Lemma tends_opp f a : tends f a -> tends (fun t => - f t) (- a).
Proof. apply (is_lim_opp f p_infty a). Qed.

Lemma tends_mult f g a b : tends f a -> tends g b -> tends (fun t => f t * g t) (a * b).
Proof. intros Hf Hg; apply (is_lim_mult f g p_infty a b); trivial; exact I. Qed.

Lemma tends_scal c f a : tends f a -> tends (fun t => c * f t) (c * a).
Proof. intros; apply tends_mult; [apply is_lim_const | assumption]. Qed.

(** The reciprocal of a limit that is not 0. *)
Lemma tends_inv f l : l <> 0 -> tends f l -> tends (fun t => / f t) (/ l).
Proof. intros Hl H; apply (is_lim_inv f p_infty l) in H; [exact H |]; congruence. Qed.

(** Limits pass through t -> T + t. *)
Lemma later f l T : tends f l -> tends (fun t => f (T + t)) l.
Proof.
  rewrite !tends_iff; intros H eps He; destruct (H eps He) as [t0 Ht0].
  exists (t0 - T); intros t Ht; apply Ht0; lra.
Qed.

Lemma derive_later (u : R -> R) T t : Derive (fun t => u (T + t)) t = Derive u (T + t).
Proof. unfold Derive; f_equal; apply Lim_ext; intros; rewrite Rplus_assoc; reflexivity. Qed.

(** One over what diverges tends to 0. *)
Lemma tends_inv_diverges s : diverges s -> tends (fun t => / s t) 0.
Proof. intros H; apply (is_lim_inv s p_infty p_infty H); discriminate. Qed.

(** Squeezed: [-B/s <= e <= B/s] and [s -> oo] give [e -> 0]. *)
Lemma squeezed e s B : diverges s ->
  (forall t, 0 < t -> - (B / s t) <= e t <= B / s t) -> tends e 0.
Proof.
  intros Hs He; pose proof (tends_scal B _ _ (tends_inv_diverges s Hs)) as H.
  rewrite Rmult_0_r in H; pose proof (tends_opp _ _ H) as H'; rewrite Ropp_0 in H'.
  refine (is_lim_le_le_loc _ _ _ _ _ _ H' H); exists 0; exact He.
Qed.

(** ** From rates to wear *)

(** Mean value theorem on [a, b], for fields differentiable for t >= 0. *)
Lemma mean_value (u : R -> R) a b : 0 <= a < b -> (forall t, 0 <= t -> ex_derive u t) ->
  exists c, a < c < b /\ u b - u a = Derive u c * (b - a).
Proof.
  intros Hab Hu; destruct (MVT_cor2 u (Derive u) a b) as [c [E Hc]]; [lra | | exists c; tauto].
  intros c Hc; apply is_derive_Reals, Derive_correct, Hu; lra.
Qed.

(** A rate of at least c: u grows at least like c t. *)
Lemma grows (u : R -> R) c : (forall t, 0 <= t -> ex_derive u t) ->
  (forall t, 0 <= t -> c <= Derive u t) -> forall t, 0 <= t -> u 0 + c * t <= u t.
Proof.
  intros Hu Hc t [Ht | <-]; [| lra].
  destruct (mean_value u 0 t) as [x [Hx E]]; [lra | assumption |].
  assert (c <= Derive u x) by (apply Hc; lra); nra.
Qed.

(** A constant rate of one per the other: [y' = c x'] gives [y = y(0) + c (x - x(0))]. *)
Lemma integrates (y x : R -> R) c :
  (forall t, 0 <= t -> ex_derive y t) -> (forall t, 0 <= t -> ex_derive x t) ->
  (forall t, 0 <= t -> Derive y t = c * Derive x t) ->
  forall t, 0 <= t -> y t = y 0 + c * (x t - x 0).
Proof.
  intros Hy Hx E t [Ht | <-]; [| lra].
  destruct (mean_value (fun t => y t - c * x t) 0 t) as [z [Hz M]]; [lra | |].
  - intros; apply (ex_derive_minus y (fun t => c * x t)); [auto | apply ex_derive_scal; auto].
  - assert (0 <= z) by lra; rewrite Derive_minus, Derive_scal, E in M; auto; [lra |].
    apply ex_derive_scal; auto.
Qed.

(** What is affine in what diverges, and rises with it. *)
Lemma diverges_affine u a f : 0 < f -> diverges u -> diverges (fun t => a + f * u t).
Proof.
  rewrite !diverges_iff; intros Hf H m; destruct (H ((m - a) / f)) as [t0 Ht0].
  exists t0; intros t Ht; specialize (Ht0 t Ht); apply Rlt_div_l in Ht0; lra.
Qed.

(** What lies above a line that rises diverges. *)
Lemma diverges_above u a c : 0 < c -> (forall t, 0 <= t -> a + c * t <= u t) -> diverges u.
Proof.
  intros Hc Hu; apply (is_lim_le_p_loc (fun t => a + c * t)).
  - exists 0; intros t Ht; apply Hu; lra.
  - apply diverges_affine; [assumption | apply is_lim_id].
Qed.

(** A rate F(u, a) that is at least F(u, w), which is positive and smooth in all u with P, as long
    as P does not end when u grows: were u bounded, then F(u, w) would have a least value on what u
    takes. *)
Lemma unbounded (u a : R -> R) (F : R -> R -> R) (w : R) (P : R -> Prop) :
  (forall t, 0 <= t -> ex_derive u t) -> (forall t, 0 <= t -> Derive u t = F (u t) (a t)) ->
  (forall t, 0 <= t -> F (u t) w <= F (u t) (a t)) -> (forall t, 0 <= t -> P (u t)) ->
  (forall x y, P x -> x <= y -> P y) -> (forall x, P x -> 0 < F x w) ->
  (forall x, P x -> ex_derive (fun x => F x w) x) -> diverges u.
Proof.
  rewrite diverges_iff; intros Hu Hr Hw HP Up Hp Hc m; set (G := fun x => F x w) in *.
  assert (P0 : P (u 0)) by (apply HP; lra).
  destruct (continuity_ab_min G (u 0) (Rmax (u 0) m)) as [x [Hx Bx]].
  - apply Rmax_l.
  - intros y Hy; apply continuity_pt_filterlim, (ex_derive_continuous G), Hc, (Up (u 0)); tauto.
  - assert (I : forall s t, 0 <= s <= t -> u s <= u t).
    { intros s t [Hs [Ht | ->]]; [| lra].
      destruct (mean_value u s t) as [c [H E]]; [lra | assumption |].
      assert (Hc' : 0 <= c) by lra.
      specialize (Hr c Hc'); specialize (Hw c Hc'); specialize (Hp (u c) (HP c Hc')); nra. }
    assert (Q0 : 0 < G x) by (apply Hp, (Up (u 0)); tauto).
    exists (Rmax 0 ((m - u 0) / G x)); intros t [Ht Hm]%Rmax_Rlt.
    assert (Q : m - u 0 < t * G x) by (apply Rlt_div_l; lra).
    destruct (Rlt_or_le m (u t)) as [| L]; [assumption | exfalso].
    destruct (mean_value u 0 t) as [c [H' E]]; [lra | assumption |].
    assert (G x <= G (u c)).
    { apply Hx; split; [apply I; lra | eapply Rle_trans; [| apply Rmax_r]].
      eapply Rle_trans; [apply (I c t); lra | exact L]. }
    specialize (Hr c); specialize (Hw c); unfold G in *; nra.
Qed.

(** A rate that tends to R: the wear of one period tends to R T. *)
Lemma accumulates (u : R -> R) r T : 0 < T -> (forall t, 0 <= t -> ex_derive u t) ->
  tends (Derive u) r -> tends (fun t => u (t + T) - u t) (r * T).
Proof.
  rewrite !tends_iff; intros HT Hu H eps He.
  assert (He' : 0 < eps / T) by (apply Rdiv_lt_0_compat; lra).
  destruct (H (eps / T) He') as [t0 Ht0]; exists (Rmax 0 t0); intros t [M1 M2]%Rmax_Rlt.
  destruct (mean_value u t (t + T)) as [c [Hc E]]; [lra | assumption |].
  rewrite E; replace (Derive u c * (t + T - t) - r * T) with ((Derive u c - r) * T) by ring.
  rewrite Rabs_mult, (Rabs_pos_eq T) by lra.
  apply Rlt_div_r; [lra | apply Ht0; lra].
Qed.

(** Cesaro: a rate that tends to R: u/t tends to R. *)
Lemma cesaro (u : R -> R) r : (forall t, 0 <= t -> ex_derive u t) ->
  tends (Derive u) r -> tends (fun t => u t / t) r.
Proof.
  rewrite !tends_iff; intros Hu H eps He.
  destruct (H (eps / 2)) as [t0 Ht0]; [lra |]; set (a := Rmax 1 (t0 + 1)).
  assert (Ha : 1 <= a) by apply Rmax_l; assert (Ha' : t0 + 1 <= a) by apply Rmax_r.
  set (b := Rabs (u a - r * a)); assert (Hb0 : 0 <= b) by apply Rabs_pos.
  exists (Rmax a (2 * b / eps)); intros t [M1 M2]%Rmax_Rlt.
  destruct (mean_value u a t) as [c [Hc E]]; [lra | assumption |].
  assert (Hd : Rabs (Derive u c - r) < eps / 2) by (apply Ht0; lra).
  assert (Hb : 2 * b < eps * t) by (rewrite (Rmult_comm eps); apply Rlt_div_l; lra).
  replace (u t / t - r) with ((u a - r * a + (Derive u c - r) * (t - a)) / t)
    by (replace (u t) with (u a + Derive u c * (t - a)) by lra; field; lra).
  unfold Rdiv; rewrite Rabs_mult, (Rabs_pos_eq (/ t)) by (left; apply Rinv_0_lt_compat; lra).
  apply Rlt_div_l; [lra |]; eapply Rle_lt_trans; [apply Rabs_triang |].
  fold b; rewrite Rabs_mult, (Rabs_pos_eq (t - a)) by lra; nra.
Qed.

(** What is equal at every time has equal rates. *)
Lemma same_rate (f g : R -> R) a b t : 0 <= t -> (forall s, 0 <= s -> f s = g s) ->
  is_derive f t a -> is_derive g t b -> a = b.
Proof.
  intros Ht E Hf Hg; pose proof (is_derive_minus _ _ _ _ _ Hf Hg) as D.
  apply is_derive_Reals in D; destruct (Req_dec a b) as [| N]; [assumption | exfalso].
  assert (P : 0 < Rabs (a - b)) by (apply Rabs_pos_lt; lra).
  destruct (D _ P) as [del B]; pose proof (cond_pos del) as Q.
  specialize (B (del / 2)); rewrite (Rabs_pos_eq (del / 2)) in B by lra.
  unfold minus, plus, opp in B; simpl in B; rewrite !E in B by lra.
  replace ((g (t + del / 2) + - g (t + del / 2) - (g t + - g t)) / (del / 2) - (a + - b))
    with (- (a - b)) in B by (field; lra).
  rewrite Rabs_Ropp in B; assert (Rabs (a - b) < Rabs (a - b)) by (apply B; lra); lra.
Qed.

(** ** Bounded fields *)

Definition bounded (f : R -> R) := exists b, forall t, 0 <= t -> Rabs (f t) <= b.

Lemma bounded_const c : bounded (fun _ => c).
Proof. exists (Rabs c); intros; apply Rle_refl. Qed.

Lemma bounded_plus f g : bounded f -> bounded g -> bounded (fun t => f t + g t).
Proof.
  intros [a A] [b B]; exists (a + b); intros t Ht; specialize (A t Ht); specialize (B t Ht).
  pose proof (Rabs_triang (f t) (g t)); lra.
Qed.

Lemma bounded_mult f g : bounded f -> bounded g -> bounded (fun t => f t * g t).
Proof.
  intros [a A] [b B]; exists (a * b); intros t Ht; rewrite Rabs_mult.
  apply Rmult_le_compat; auto using Rabs_pos.
Qed.

Lemma bounded_opp f : bounded f -> bounded (fun t => - f t).
Proof. intros [a A]; exists a; intros; rewrite Rabs_Ropp; auto. Qed.

(** An exponential of what falls below all bounds. *)
Lemma exp_vanishes (u a : R -> R) (c : R) : 0 < c -> diverges u -> bounded a ->
  tends (fun t => exp (a t - c * u t)) 0.
Proof.
  intros Hc Hu [b Ha]; apply (tends_ext (fun t => / exp (c * u t - a t))).
  { intros t _; rewrite <- exp_Ropp; f_equal; ring. }
  apply tends_inv_diverges, (is_lim_le_p_loc (fun t => 1 - b + c * u t)).
  - exists 0; intros t Ht; pose proof (exp_ineq1_le (c * u t - a t)).
    specialize (Ha t (Rlt_le _ _ Ht)); apply Rabs_le_between in Ha; lra.
  - apply diverges_affine; assumption.
Qed.
