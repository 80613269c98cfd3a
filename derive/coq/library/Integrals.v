(** Continuity in time, and integrals over what a field takes: separated variables, by parts. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Wear Require Import Limits.
Open Scope R_scope.

(** Continuous for t >= 0, at 0 from the right: [Rabs s] is no time before. *)
Definition continuous_in_time (y : R -> R) := forall t, continuous (fun s => y (Rabs s)) t.

Lemma smooth_in_time y : (forall t, 0 <= t -> ex_derive y t) -> continuous_in_time y.
Proof.
  intros H t; apply (continuous_comp Rabs y); [apply continuous_Rabs |].
  apply (ex_derive_continuous y), H, Rabs_pos.
Qed.

Lemma at_positive_time (y : R -> R) t : 0 < t -> locally t (fun s => y (Rabs s) = y s).
Proof.
  intros Ht; apply (locally_interval _ t 0 p_infty); [exact Ht | exact I |].
  intros s Hs _; simpl in Hs; rewrite Rabs_pos_eq; lra.
Qed.

(** Intermediate values. *)
Lemma reached y a b z : continuous_in_time y -> 0 <= a -> 0 <= b ->
  Rmin (y a) (y b) <= z <= Rmax (y a) (y b) -> exists s, 0 <= s /\ y s = z.
Proof.
  intros H Ha Hb Hz; destruct (IVT_gen (fun s => y (Rabs s)) a b z) as [s [_ E]].
  - intros x; apply continuity_pt_filterlim, H.
  - rewrite !Rabs_pos_eq by assumption; exact Hz.
  - exists (Rabs s); split; [apply Rabs_pos | exact E].
Qed.

(** The only root of [x = F x t], where F decreases in x and is continuous in time. *)
Lemma continuous_root (F : R -> R -> R) (p : R -> R) :
  (forall x y t, 0 <= t -> x <= y -> F y t <= F x t) -> (forall x, continuous_in_time (F x)) ->
  (forall t, 0 <= t -> p t = F (p t) t) -> continuous_in_time p.
Proof.
  intros D C E t; apply filterlim_locally; intros eps; pose proof (cond_pos eps) as P.
  pose proof (E (Rabs t) (Rabs_pos t)) as Et; set (x := p (Rabs t)) in *.
  assert (A : F (x + eps) (Rabs t) < x + eps)
    by (pose proof (D x (x + eps) (Rabs t) (Rabs_pos t)); lra).
  assert (B : x - eps < F (x - eps) (Rabs t))
    by (pose proof (D (x - eps) x (Rabs t) (Rabs_pos t)); lra).
  pose proof (C _ t _ (open_lt _ _ A) : locally t (fun s => F (x + eps) (Rabs s) < x + eps)) as A'.
  pose proof (C _ t _ (open_gt _ _ B) : locally t (fun s => x - eps < F (x - eps) (Rabs s))) as B'.
  generalize (filter_and _ _ A' B'); apply filter_imp; intros s [As Bs].
  pose proof (E (Rabs s) (Rabs_pos s)) as Es.
  pose proof (D (p (Rabs s)) (x - eps) (Rabs s) (Rabs_pos s)).
  pose proof (D (x + eps) (p (Rabs s)) (Rabs s) (Rabs_pos s)).
  apply Rabs_lt_between; unfold minus, plus, opp; simpl; split;
    apply Rnot_le_lt; intro; lra.
Qed.

(** The slope of a chord from l, continuous at l. *)
Lemma chord (F : R -> R) l d : is_derive F l d ->
  exists G, continuous G l /\ G l = d /\ forall y, F y - F l = G y * (y - l).
Proof.
  intros H; set (G := fun y => if Req_EM_T y l then d else (F y - F l) / (y - l)).
  assert (Gl : G l = d) by (unfold G; destruct (Req_EM_T l l); congruence).
  exists G; split; [| split; [exact Gl |]].
  - apply is_derive_Reals in H; apply continuity_pt_filterlim; intros eps He.
    destruct (H eps He) as [del Hd]; exists del; split; [apply cond_pos |].
    intros y [[_ Hy] Hyl]; simpl in *; unfold R_dist in *; rewrite Gl.
    unfold G; destruct (Req_EM_T y l) as [-> | E]; [rewrite Rminus_diag_eq, Rabs_R0; trivial |].
    specialize (Hd (y - l)); replace (l + (y - l)) with y in Hd by ring; apply Hd; lra.
  - intros y; unfold G; destruct (Req_EM_T y l) as [-> | E]; [ring | field; lra].
Qed.

(** The rate of y, where [u = W(y)] and W has a slope w at its present value. *)
Lemma rate_of_inverse (y u W g : R -> R) (w r t : R) : continuous_in_time y -> 0 < t ->
  (forall s, 0 <= s -> u s = W (y s)) -> ex_derive u t -> is_derive W (y t) w -> w <> 0 ->
  g (y t) = r * w -> ex_derive y t /\ g (y t) * Derive y t = r * Derive u t.
Proof.
  intros C Ht E Hu HW Hw Hg; cut (is_derive y t (Derive u t / w)).
  { intros D; split; [eexists; exact D |].
    rewrite Hg, (is_derive_unique _ _ _ D); field; exact Hw. }
  apply Derive_correct in Hu; pose proof (at_positive_time y t Ht) as Q.
  destruct (chord W _ w HW) as [G [HG [G0 EG]]], (chord u t _ Hu) as [H [HH [H0 EH]]].
  assert (Cy : continuous y t).
  { apply (continuous_ext_loc _ (fun s => y (Rabs s))); [exact Q | apply C]. }
  assert (CG : continuous (fun s => G (y s)) t) by (apply continuous_comp; assumption).
  rewrite <- G0 in Hw; assert (A : locally t (fun s => G (y s) <> 0))
    by (apply (CG (fun z => z <> 0)), open_neq, Hw).
  assert (K : continuous (fun s => H s / G (y s)) t)
    by (apply (continuous_mult H); [| apply continuous_Rinv_comp]; assumption).
  assert (B : locally t (fun s => 0 < s)) by exact (open_gt 0 t Ht).
  apply is_derive_Reals; intros eps He.
  pose proof (proj1 (filterlim_locally _ _) K (mkposreal eps He)) as L.
  destruct (filter_and _ _ (filter_and _ _ A B) L) as [del D]; exists del; intros h Hh Hd.
  destruct (D (t + h)) as [[Gn P] S].
  { unfold ball; simpl; unfold AbsRing_ball, abs, minus, plus, opp; simpl.
    replace (t + h + - t) with h by ring; exact Hd. }
  replace ((y (t + h) - y t) / h) with (H (t + h) / G (y (t + h))).
  { rewrite <- G0, <- H0; exact S. }
  specialize (EH (t + h)); rewrite !E, EG in EH by lra.
  apply (Rmult_eq_reg_l (G (y (t + h)))); [| assumption]; field_simplify; [| lra | assumption].
  apply (Rmult_eq_reg_r h); [| assumption]; field_simplify; [lra | assumption].
Qed.

Lemma integrable (g : R -> R) a b : (forall x, continuous g x) -> ex_RInt g a b.
Proof. intros H; apply (ex_RInt_continuous g); auto. Qed.

Lemma derive_integral (g : R -> R) a x : (forall x, continuous g x) ->
  is_derive (fun x => RInt g a x) x (g x).
Proof.
  intros H; apply (is_derive_RInt g _ a); [| apply H].
  apply filter_forall; intros; apply (RInt_correct g), integrable, H.
Qed.

(** Separated variables: [g(y) y' = c] at every time. *)
Lemma separates (y g : R -> R) (c : R) : continuous_in_time y ->
  (forall t, 0 <= t -> continuous g (y t)) -> (forall t, 0 < t -> ex_derive y t) ->
  (forall t, 0 < t -> g (y t) * Derive y t = c) -> forall t, 0 <= t -> c * t = RInt g (y 0) (y t).
Proof.
  intros Hc Hg Hy E t Ht; set (f := fun s => y (Rabs s)).
  assert (Cf : forall s, continuity_pt f s) by (intros; apply continuity_pt_filterlim, Hc).
  destruct (continuity_ab_maj f 0 t) as [b [Hb [Ib _]]]; auto.
  destruct (continuity_ab_min f 0 t) as [a [Ha [Ia _]]]; auto.
  assert (N : forall s, 0 <= s <= t -> f a <= y s <= f b).
  { intros s Hs; rewrite <- (Rabs_pos_eq s) by lra; split; [apply Ha | apply Hb]; exact Hs. }
  destruct (C0_extension_le g (f a) (f b)) as [h [Hh Eh]].
  { intros z Hz; destruct (reached y (Rabs a) (Rabs b) z) as [s [Hs <-]];
      [assumption | apply Rabs_pos | apply Rabs_pos | | exact (Hg s Hs)].
    rewrite Rmin_left, Rmax_right by (apply (Rle_trans _ z); apply Hz); exact Hz. }
  assert (D : forall s, 0 < s -> s < t -> is_derive (fun s => RInt h (y 0) (f s) - c * s) s 0).
  { intros s Hs Hst; evar_last.
    - apply (is_derive_minus (fun s => RInt h (y 0) (f s)) (fun s => c * s));
        [| apply is_derive_scal, is_derive_id].
      apply (is_derive_comp (RInt h (y 0)) f s); [apply derive_integral, Hh |].
      apply (is_derive_ext_loc y); [| apply Derive_correct, Hy, Hs].
      generalize (at_positive_time y s Hs); apply filter_imp; intros; symmetry; assumption.
    - unfold f, minus, plus, opp, scal, one; simpl; unfold mult; simpl; rewrite Rabs_pos_eq by lra.
      rewrite Eh, Rmult_comm, E by (try apply N; lra); ring. }
  destruct (MVT_gen (fun s => RInt h (y 0) (f s) - c * s) 0 t (fun _ => 0)) as [s [_ M]].
  - rewrite Rmin_left, Rmax_right by exact Ht; intros; apply D; lra.
  - intros s _; apply continuity_pt_filterlim.
    apply (continuous_minus (fun s => RInt h (y 0) (f s)) (fun s => c * s)).
    + apply (continuous_comp f (RInt h (y 0))); [apply Hc |].
      apply (ex_derive_continuous (RInt h (y 0))); eexists; apply derive_integral, Hh.
    + apply (ex_derive_continuous (fun s => c * s)); auto_derive; trivial.
  - unfold f in M; rewrite (Rabs_pos_eq t Ht), Rabs_R0, RInt_point in M; unfold zero in M.
    simpl in M; rewrite (RInt_ext g h); [lra |]; intros z Hz; symmetry; apply Eh.
    pose proof (N 0); pose proof (N t); revert Hz; unfold Rmin, Rmax; destruct Rle_dec; lra.
Qed.

(** By a primitive of a part of the integrand: [F' = g - r]. *)
Lemma by_parts (y F g r : R -> R) : continuous_in_time y ->
  (forall t, 0 <= t -> is_derive F (y t) (g (y t) - r (y t))) ->
  (forall t, 0 <= t -> continuous g (y t)) -> (forall t, 0 <= t -> continuous r (y t)) ->
  forall t, 0 <= t -> RInt g (y 0) (y t) = F (y t) - F (y 0) + RInt r (y 0) (y t).
Proof.
  intros C D Hg Hr t Ht.
  assert (A : forall P : R -> Prop, (forall t, 0 <= t -> P (y t)) ->
    forall z, Rmin (y 0) (y t) <= z <= Rmax (y 0) (y t) -> P z).
  { intros P H z Hz; destruct (reached y 0 t z) as [s [Hs <-]]; auto; lra. }
  pose proof (ex_RInt_continuous g _ _ (A (continuous g) Hg)) as Ig.
  pose proof (ex_RInt_continuous r _ _ (A (continuous r) Hr)) as Ir.
  pose proof (RInt_minus g r _ _ Ig Ir : RInt (fun s => g s - r s) (y 0) (y t) = _ - _).
  assert (RInt (fun s => g s - r s) (y 0) (y t) = F (y t) - F (y 0)); [| lra].
  apply is_RInt_unique, (is_RInt_derive F (fun s => g s - r s)); intros z Hz.
  - exact (A (fun z => is_derive F z (g z - r z)) D z Hz).
  - apply (continuous_minus g r); [exact (A _ Hg z Hz) | exact (A _ Hr z Hz)].
Qed.

Lemma RInt_zero (a b : R) : RInt (fun _ => 0) a b = 0.
Proof. rewrite (RInt_const a b 0); apply Rmult_0_r. Qed.
