(** The tactics of exported steps: side conditions, equal arguments, signs. *)

From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Wear Require Import Tanh Limits Integrals Drift.
Open Scope R_scope.

(** An unspecified contact law; what is assumed of it stands in the lemmas. *)
Class contact_law := { phi : R -> R }.

(** ** Facts that the tactics use *)

Lemma one_minus_tanh_square_pos (x : R) : 0 < 1 - tanh x ^ 2.
Proof. pose proof (tanh_below x); pose proof (tanh_above x); nra. Qed.

Lemma below_inverse (a b : R) : 0 < b -> a < / b -> a * b < 1.
Proof. intros Hb H; apply (Rmult_lt_compat_r b) in H; rewrite ?Rinv_l in H; lra. Qed.

Lemma slope_of_decreasing (f : R -> R) : (forall r r', r < r' -> f r' < f r) ->
  (forall r, ex_derive f r) -> forall r, Derive f r <= 0.
Proof.
  intros Hf Hd r; pose (D := fun r => ex_derive_Reals_0 f r (Hd r)).
  rewrite <- (Derive_Reals f r (D r)); apply (nonpos_derivative_0 f D).
  intros x y [H | ->]; [left; apply Hf, H | right; reflexivity].
Qed.

(** A quadratic polynomial of negative discriminant. *)
Lemma quadratic_positive (a b x m n : R) : 0 < a -> b ^ 2 < a * (m + n) ->
  0 < 2 * b * x + a * x ^ 2 + m + n.
Proof.
  intros Ha H; apply (Rmult_lt_reg_l a); [assumption |].
  pose proof (pow2_ge_0 (b + a * x)); nra.
Qed.

(** A sum of which one part is positive unless u vanishes, and the other one if it does. *)
Lemma square_and_rest (b u q s : R) : 0 <= u -> 0 < s -> 0 < b -> 0 < b * u + (- (q * u) + s) ^ 2.
Proof. intros [Hu | <-] Hs Hb; [pose proof (pow2_ge_0 (- (q * u) + s)) |]; nra. Qed.

(** The order of functions that increase on D decides a threshold. *)
Lemma threshold (D : R -> Prop) (F : R -> R) (x s e : R) :
  (forall a b, D a -> a < b -> F a < F b) -> D x -> D s -> F s = e -> s < x <-> e < F x.
Proof.
  intros HF Hx Hs <-; split; intro H; [auto |].
  destruct (Rtotal_order s x) as [? | [-> | L]]; [assumption | lra | specialize (HF x s Hx L); lra].
Qed.

(** The mean value theorem for the logarithm of a positive function. *)
Lemma log_slope (F F' : R -> R) (m a b : R) : (forall x, 0 < F x) ->
  (forall x, is_derive F x (F' x)) -> (forall x, Rabs (F' x) <= m * F x) ->
  Rabs (ln (F a / F b)) <= m * Rabs (a - b).
Proof.
  intros P D H; assert (L : forall x, is_derive (fun x => ln (F x)) x (F' x / F x)).
  { intro x; apply (is_derive_comp ln F x (/ F x) (F' x)); [| apply D].
    apply is_derive_Reals, derivable_pt_lim_ln, P. }
  rewrite ln_div by apply P; apply (bounded_variation (fun x => ln (F x)) (fun x => F' x / F x)).
  intros x _; split; [apply L |].
  unfold Rdiv; rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq (F x)) by (left; apply P).
  apply Rle_div_l; [apply P | apply H].
Qed.

Lemma root_scaled (a x : R) : 0 < a -> sqrt (x / a ^ 2) = sqrt x / a.
Proof. intro H; rewrite sqrt_div_alt, sqrt_pow2 by (try apply pow_lt; lra); reflexivity. Qed.

(** What grows with u, over what grows with it at least f times as fast. *)
Lemma ratio_below (x s a b f u : R) : f * u + b <= s -> 0 < b -> 0 < f -> 0 <= u -> 0 <= a ->
  x <= a + u -> x / s <= a / b + / f.
Proof.
  intros Hs Hb Hf Hu Ha Hx; assert (P : 0 < s) by nra; apply Rle_div_l; [exact P |].
  assert (/ f * (f * u) = u) by (field; lra); assert (a / b * b = a) by (field; lra).
  assert (0 < / f) by (apply Rinv_0_lt_compat, Hf).
  assert (0 <= a / b) by (apply Rmult_le_pos; [| left; apply Rinv_0_lt_compat]; assumption).
  assert (/ f * (f * u + b) <= / f * s) by (apply Rmult_le_compat_l; lra).
  assert (a / b * b <= a / b * s) by (apply Rmult_le_compat_l; nra).
  nra.
Qed.

Lemma sign_of {x e : R} : x = e -> 0 < x -> 0 < e.
Proof. intros <-; trivial. Qed.

(** ** Signs *)

(** A goal [0 < e], [0 <= e] or [e <> 0] by the signs of the parts of e. *)
Ltac positive :=
  match goal with
  | |- _ /\ _ => split; positive
  | |- _ <> _ => first [assumption | apply Rgt_not_eq, Rlt_gt; positive | apply Rlt_not_eq; lra
      | not_zero | apply Rmult_integral_contrapositive_currified; positive]
  | |- 0 < _ => first [assumption | lra | positive_part]
  | |- 0 <= _ => first [assumption | lra | positive_part]
  | |- _ => lra
  end
with not_zero :=
  unfold Rdiv, Rminus in *; match goal with D : _ <> 0 |- _ <> 0 =>
    let E := fresh in intro E; apply D; field_simplify_eq; [lra | repeat split; assumption] end
with positive_part :=
  match goal with
  | E : ?x = _ + (- (_ * _) + _) ^ 2 |- 0 < ?x => rewrite E; positive_part
  | |- 0 < ?b * ?u + (- (_ * ?u) + _) ^ 2 => apply square_and_rest; positive
  | |- 0 < ?a * ?b => apply Rmult_lt_0_compat; positive
  | |- 0 < ?a / ?b => apply Rdiv_lt_0_compat; positive
  | |- 0 < / ?a => apply Rinv_0_lt_compat; positive
  | |- 0 < ?a ^ ?n => apply pow_lt; positive
  | |- 0 < exp _ => apply exp_pos
  | |- 0 < 1 - tanh _ ^ 2 => apply one_minus_tanh_square_pos
  | |- context [tanh ?x] => pose proof (tanh_above x); pose proof (tanh_below x); lra
  | |- 0 < sqrt _ => apply sqrt_lt_R0; positive
  | |- 0 < 2 * _ * _ + _ * _ ^ 2 + _ + _ => apply quadratic_positive; [positive | assumption]
  | |- 0 < _ + _ => first [apply Rplus_lt_0_compat; positive | apply Rplus_le_lt_0_compat; positive]
  | |- 0 <= ?a * ?b => apply Rmult_le_pos; positive
  | |- 0 <= ?a / ?b => apply Rmult_le_pos; [positive | left; apply Rinv_0_lt_compat; positive]
  | |- 0 <= ?a ^ 2 => apply pow2_ge_0
  | |- 0 <= tanh _ => rewrite <- tanh_0; apply tanh_order; positive
  | |- 0 <= ?a + ?b => apply Rplus_le_le_0_compat; positive
  | |- 0 <= ?a => left; positive_part
  | |- 0 < _ => solve [auto | nra]
  | |- _ => nra
  end.

(** The signs of sums of which one part is a square. *)
Ltac positive_sums :=
  repeat match goal with
  | E : ?x = _ + (- (_ * _) + _) ^ 2 |- _ => assert (0 < x) by positive; clear E
  end.

(** State a fact, unless it is known. *)
Ltac state F :=
  let P := type of F in lazymatch goal with _ : P |- _ => fail | _ => pose proof F end.

(** The goal by arithmetic alone, from the facts of the context. *)
Ltac bounds :=
  repeat match goal with
  | H : Rabs _ <= _ |- _ => apply Rabs_le_between in H
  | H : 0 < sqrt _ |- _ => rewrite <- sqrt_0 in H at 1; apply sqrt_lt_0_alt in H
  | H : 0 < Rabs _ |- _ => rewrite Rabs_pos_eq in H by lra
  | H : _ < / _ |- _ => apply below_inverse in H; [| positive]
  | |- Rabs _ <= _ => apply Rabs_le; split
  | |- context [sin ?a] => state (SIN_bound a)
  | |- context [tanh ?a] => state (tanh_below a); pose proof (tanh_above a)
  | |- context [exp ?a] => state (exp_pos a)
  end.

Ltac below_logarithm :=
  match goal with |- ?a < ln _ => apply exp_lt_inv; pose proof (exp_pos a); rewrite exp_ln; lra end.

(** A part of a sum of squares is below its root. *)
Ltac below_root :=
  match goal with |- ?y <= sqrt (?x ^ 2 + _) =>
    apply Rle_trans with (sqrt (y * y)); [rewrite sqrt_square by positive; lra |];
    apply sqrt_le_1_alt; pose proof (pow2_ge_0 x); lra end.

Ltac arithmetic :=
  first [lra | below_logarithm | below_root | bounds; solve [lra | positive | nra]].

(** ** Equal arguments of functions *)

Ltac same_argument :=
  solve [reflexivity | ring | unfold Rdiv; rewrite ?Rinv_mult; ring | field; positive
    | do 2 f_equal; field; positive
    | match goal with E : _ * _ = _ |- _ => field_simplify_eq; [lra | positive] end].

(** Two different arguments of f in the goal, for which the tactic k succeeds. *)
Ltac at_two f k :=
  match goal with |- context [f ?a] => match goal with |- context [f ?b] =>
    tryif constr_eq a b then fail else k a b end end.

Ltac same_under f :=
  at_two f ltac:(fun a b => replace (f b) with (f a) by (f_equal; same_argument)).

Ltac same_under_law := match goal with |- context [@phi ?c _] => same_under (@phi c) end.

Ltac opposite_under f value law :=
  at_two f ltac:(fun a b => let v := value (f a) in
    replace (f b) with v by (rewrite <- law; f_equal; same_argument)).

(** An exponential as the inverse of another, or by the product of two. *)
Ltac exp_of_sum :=
  match goal with |- context [exp ?c] => match goal with |- context [exp ?a] =>
    tryif constr_eq a c then fail else first
    [ replace (exp c) with (/ exp a) by (rewrite <- exp_Ropp; f_equal; same_argument)
    | match goal with |- context [exp ?b] => tryif constr_eq b c then fail else first
      [ replace (exp c) with (exp a * exp b) by (rewrite <- exp_plus; f_equal; same_argument)
      | replace (exp c) with (/ (exp a * exp b)) by (rewrite <- exp_plus, <- exp_Ropp;
          f_equal; same_argument) ] end ] end end.

Ltac same_functions :=
  repeat first [same_under_law | same_under tanh | same_under exp | same_under ln | same_under sqrt
    | opposite_under tanh ltac:(fun v => constr:(- v)) tanh_opp
    | opposite_under Rabs ltac:(fun v => v) Rabs_Ropp].

Ltac same_exponentials := rewrite ?tanh_exp; repeat first [same_under exp | exp_of_sum];
  repeat match goal with |- context [exp ?a] => state (exp_pos a) end.

Ltac exp_of_logarithm :=
  match goal with |- context [exp ?a] => match goal with |- context [ln ?b] =>
    replace (exp a) with b by (transitivity (exp (ln b)); [symmetry; apply exp_ln |
      f_equal; field]; first [positive | eapply Rlt_trans; [apply exp_pos | eassumption]]) end end.

(** ** Equations *)

Ltac in_contact :=
  repeat match goal with |- context [Rle_dec ?a ?b] => destruct (Rle_dec a b); [| lra] end.

(** The slope of a contact law is not positive. *)
Ltac slopes :=
  repeat match goal with
  | F : forall r r', r < r' -> @phi ?c r' < @phi ?c r, D : forall r, ex_derive (@phi ?c) r
    |- context [Derive (@phi ?c) ?a] =>
      state (slope_of_decreasing (@phi c) F D a)
  end.

(** A root of a square, and a modulus of what is not negative. *)
Ltac roots :=
  repeat first
  [ rewrite Rabs_pos_eq by arithmetic
  | match goal with |- context [sqrt ?x] =>
      match goal with H : _ 0 ?y |- _ => replace (sqrt x) with y
        by (symmetry; apply sqrt_lem_1; [nra | lra | ring]) end end ].

(** Roots of what differs by the square of a factor a > 0. *)
Ltac same_roots a :=
  repeat at_two sqrt ltac:(fun x y =>
    replace (sqrt y) with (sqrt x / a) by (rewrite <- root_scaled; [f_equal; field; lra | lra])).

(** The square of a root. *)
Ltac square_of_root :=
  match goal with |- context [sqrt ?x] =>
    try (assert (0 < x) by positive); assert (0 <= x) by positive; let E := fresh in
    assert (E : sqrt x * sqrt x = x) by (apply sqrt_sqrt; assumption);
    first [ring [E] | field [E]; positive] end.

Ltac identity := in_contact; slopes; rewrite ?pow2_sqrt by positive; same_functions; first
  [ reflexivity | ring | field; positive | same_exponentials; field; positive | square_of_root
  | progress roots; first [reflexivity | ring | field; positive]
  | exp_of_logarithm; field; positive ].

(** Write [Derive f] for [Derive (fun x => f x)]. *)
Ltac plain_slopes :=
  repeat match goal with |- context [Derive (fun x => ?f x) ?a] =>
    progress change (Derive (fun x => f x) a) with (Derive f a) end.

(** The derivative of an expression, by Coquelicot. *)
Ltac derived := auto_derive; [repeat split; first [positive | auto] | plain_slopes; identity].

(** An equation; [ln x = y] by [x = exp y]. *)
Ltac equal :=
  try (match goal with |- ln ?x = ?y => replace x with (exp y); [apply ln_exp |] end); identity.

(** ** What a claim rests on *)

(** An equation that is to be inserted. *)
Definition to_insert (P : Prop) := P.

Ltac given F := let P := fresh "P" in pose proof F as P; sorted P
with sorted P :=
  lazymatch type of P with
  | _ /\ _ => let Q := fresh "P" in destruct P as [P Q]; sorted P; sorted Q
  | ?x = ?e => change (to_insert (x = e)) in P
  | _ => idtac
  end.

(** Insert the given equations for single quantities everywhere. *)
Ltac insert :=
  repeat match goal with E : to_insert (?x = ?e) |- _ => unfold to_insert in E;
    lazymatch x with
    | _ + _ => idtac | _ - _ => idtac | - _ => idtac
    | _ * _ => idtac | _ / _ => idtac | _ ^ _ => idtac
    | _ => lazymatch e with context [x] => idtac | _ => try rewrite E in *; clear E end
    end end.

Lemma multiple_of (c l r a b : R) : l = r -> a - b = c * (l - r) -> a = b.
Proof. intros -> H; apply Rminus_diag_uniq; rewrite H; ring. Qed.

(** The goal is c times the equation F, or that equation, where others are inserted; those that
    are implicit are inserted into F, once. *)
Ltac multiple c F :=
  let P := fresh "P" in pose proof F as P;
  repeat match goal with E : to_insert (?x = ?e) |- _ =>
    lazymatch e with context [x] => unfold to_insert in E; try rewrite E in P; clear E end end;
  apply (multiple_of c _ _ _ _ P); insert; identity.

(** The sides of the goal are equal where the equation F and others are inserted, or it is F, or F
    is inserted in one side. *)
Ltac by_equation F := first [given F; insert; equal | multiple 1 F
  | match goal with |- _ = ?b => let B := fresh in set (B := b); rewrite F; subst B; identity end].

(** ** Inequalities *)

Ltac same_inequality H := revert H; same_functions; intro H; arithmetic.

Ltac difference := first [apply Rminus_le_0 | apply Rminus_lt_0].

Ltac manifest_as e := difference; match goal with |- ?r 0 ?d => replace d with e by identity end.

(** The goal [a <= b] or [a < b] where [b - a] is the expression e of manifest sign. *)
Ltac manifest e := manifest_as e; arithmetic.

(** The same, where the fact H gives the sign. *)
Ltac manifest_by H e := manifest_as e; same_inequality H.

(** The goal is c times the inequality H. *)
Ltac from_inequality H c :=
  first [apply Rminus_le_0 in H | apply Rminus_lt_0 in H]; difference;
  let e := match type of H with _ 0 ?e => e end in
  match goal with |- _ 0 ?d => replace d with (c * e) by identity end; positive.

(** The goal [f a < f b] for a function that is seen to increase. *)
Ltac increasing :=
  match goal with
  | |- / _ < / _ => apply Rinv_lt_contravar; [positive | increasing]
  | |- exp _ < exp _ => apply exp_increasing; increasing
  | |- tanh _ < tanh _ => apply tanh_increasing; increasing
  | |- ?c + _ < ?c + _ => apply Rplus_lt_compat_l; increasing
  | |- _ + ?c < _ + ?c => apply Rplus_lt_compat_r; increasing
  | |- ?c - _ < ?c - _ => apply Rplus_lt_compat_l, Ropp_lt_contravar; increasing
  | |- ?c * _ < ?c * _ => apply Rmult_lt_compat_l; [positive | increasing]
  | |- ?c / _ < ?c / _ => apply Rmult_lt_compat_l; [positive | increasing]
  | |- _ / ?c < _ / ?c => apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat; positive | increasing]
  | |- _ => assumption
  end.

(** The goal [f a <= f b] for a function that is seen not to decrease. *)
Ltac nondecreasing :=
  match goal with
  | |- tanh _ <= tanh _ => apply tanh_order; nondecreasing
  | |- ?c + _ <= ?c + _ => apply Rplus_le_compat_l; nondecreasing
  | |- _ + ?c <= _ + ?c => apply Rplus_le_compat_r; nondecreasing
  | |- _ - ?c <= _ - ?c => apply Rplus_le_compat_r; nondecreasing
  | |- ?c - _ <= ?c - _ => apply Rplus_le_compat_l, Ropp_le_contravar; nondecreasing
  | |- ?c * _ <= ?c * _ => apply Rmult_le_compat_l; [positive | nondecreasing]
  | |- _ / ?c <= _ / ?c =>
      apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; positive | nondecreasing]
  | |- _ => lra
  end.

Ltac same_as_known := match goal with H : _ <= _ |- _ => solve [same_inequality H] end.

(** The goal by the order of tanh, or of a law, at two places, where e is the difference of its
    sides; or by that of tanh and an exponential. *)
Ltac ordered e :=
  match goal with
  | |- context [exp _] => match goal with |- context [tanh ?a] =>
      let Q := fresh in pose proof (share_below_exp a) as Q; manifest_by Q e end
  | |- context [tanh _] => at_two tanh ltac:(fun a b => first
      [ assert (tanh a <= tanh b) by (apply tanh_order; unfold Rdiv in *; lra)
      | assert (tanh (- a) <= tanh b) by (apply tanh_order; unfold Rdiv in *; lra) ];
      rewrite ?tanh_opp in *; manifest e)
  | H : forall r r', r < r' -> ?f r' < ?f r |- _ => at_two f ltac:(fun a b =>
      assert (f a <= f b) by (destruct (Req_dec a b) as [-> | ?];
        [lra | left; apply H; unfold Rdiv in *; lra]); manifest e)
  end.

(** State which quotients in the goal are positive. *)
Ltac positive_quotients :=
  repeat match goal with |- context [?a / ?b] => lazymatch goal with _ : 0 < a / b |- _ => fail
    | _ => assert (0 < a / b) by positive end end.

(** Quotients with one denominator, or with one that grows with a part of the numerator. *)
Ltac fractions :=
  lazymatch goal with
  | |- _ / ?d <= _ / ?d => apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; positive |]
  | |- _ / _ <= _ / _ + / _ =>
      eapply ratio_below; [eassumption | positive | positive | positive | positive |]
  end;
  positive_quotients; bounds; lra.

(** An inequality, where e is the difference of its sides by factors. *)
Ltac by_signs e := first [solve [arithmetic] | ordered e | manifest e | fractions | same_as_known].

(** ** Limits of expressions, part by part *)

Ltac limit_of_parts :=
  cbv beta; match goal with
  | H : tends ?f _ |- tends ?f _ => exact H
  | |- tends (fun _ => ?c) _ => apply is_lim_const
  | |- tends (fun t => @?f t + @?g t) _ => apply (is_lim_plus' f g); limit_of_parts
  | |- tends (fun t => @?f t - @?g t) _ => apply (is_lim_minus' f g); limit_of_parts
  | |- tends (fun t => - @?f t) _ => apply (tends_opp f); limit_of_parts
  | |- tends (fun t => @?f t * @?g t) _ => apply (tends_mult f g); limit_of_parts
  | |- tends (fun t => @?f t / @?g t) _ => apply (tends_mult f (fun t => / g t)); limit_of_parts
  | |- tends (fun t => / @?f t) _ => eapply (tends_inv f); [| limit_of_parts]; positive
  | |- tends (fun t => tanh (@?f t)) _ => apply (is_lim_comp_continuous f tanh);
      [limit_of_parts | apply tanh_continuous]
  | |- tends (fun t => exp (@?f t)) _ => apply (is_lim_comp_continuous f exp);
      [limit_of_parts | apply continuous_exp]
  | |- tends (fun t => @phi ?c (@?f t)) _ => apply (is_lim_comp_continuous f (@phi c));
      [limit_of_parts | apply (ex_derive_continuous (@phi c)); auto]
  end.

(** A limit that is known, of what diverges that of its reciprocal. *)
Ltac known F := let L := fresh in pose proof F as L; cbv beta in L.
Ltac known_limit F := first [known (tends_inv_diverges _ F) | known F].

(** The same, and one period later. *)
Ltac known_and_later T F :=
  known_limit F; first [known (later _ _ T (tends_inv_diverges _ F)) | known (later _ _ T F)].

(** What a limit is called equals it, since limits are unique. *)
Ltac by_name F :=
  match goal with D : tends ?f ?n |- ?n = _ => apply (tends_unique f _ _ D) end;
  eapply tends_value; [| generalize F; apply tends_ext; intros t Ht; first
    [reflexivity | unfold Rdiv; f_equal; field; positive]]; identity.

(** Two limits are equal, or a multiple of one is 0. *)
Ltac same_limit :=
  eexists; split; [eassumption | first [ring | eapply tends_value; [| eassumption]; identity]].

Ltac limit := eapply tends_value; [| limit_of_parts]; identity.

(** ** General theorems, their functions read off the goal and the facts *)

(** A goal [s < x <-> e < F x] for a function F that is seen to increase. *)
Ltac threshold_on D :=
  match goal with |- ?s < ?x <-> ?e < ?l =>
    match eval pattern x in l with ?F _ => apply (threshold D F x s e) end end;
  cbv beta; solve [exact I | intros; increasing | positive | bounds; identity].

(** Two inequalities: of a threshold, or each a multiple of the other. *)
Ltac equivalent :=
  first [threshold_on (fun x => 0 < x) | threshold_on (fun _ : R => True)
    | split; let Q := fresh in intro Q; first [arithmetic | from_inequality Q 1]].

(** State the derivative of f at a before the goal, by Coquelicot. *)
Ltac slope_of f a :=
  let D := fresh in eassert (D : is_derive f a _) by
    (auto_derive; [repeat split; first [positive | auto] | cbv beta; reflexivity]);
  revert D; plain_slopes.

(** Take the derivative in the goal. *)
Ltac differentiated :=
  match goal with |- context [Derive (fun x => @?f x) ?a] =>
    slope_of f a; let D := fresh in intro D; rewrite (is_derive_unique f a _ D); clear D end.

(** The fact H states that [y' = c x']. *)
Ltac integrated H :=
  match type of (H 0 (Rle_refl 0)) with Derive ?y _ = ?e => match e with context [Derive ?x 0] =>
    match eval pattern (Derive x 0) in e with ?F _ => rewrite (integrates y x (F 1)); cbv beta;
      [insert; identity | | | intros s Hs; rewrite (H s Hs); identity |]; assumption
  end end end.

(** Insert the first value of a field. *)
Ltac at_start y Q := try match goal with H : y 0 = _ |- _ => rewrite H in Q end.

(** The rate of y at a time after 0, by H, where the fact F gives the wear as a function of y under
    a constant load; a times the slope of that function is p > 0. *)
Ltac rate_by_inverse y g F H p a :=
  match type of (F 0 (Rle_refl 0)) with ?u 0 = ?e => match eval pattern (y 0) in e with ?W _ =>
    match type of H with 0 < ?t => slope_of W (y t); let D := fresh in intro D;
      apply (fun E S => rate_of_inverse y u W g _ _ t ltac:(assumption) H E S D) end end end;
  [ intros s Hs; rewrite (F s Hs);
    try match goal with L : forall t, _ -> ?x t = ?x 0 |- _ => rewrite (L s Hs) end; reflexivity
  | auto
  | match goal with |- ?w <> 0 => let Z := fresh in intro Z; assert (0 < p) by positive;
      assert (w * a = p) by (given (F _ (Rlt_le _ _ H)); insert; identity);
      rewrite Z, Rmult_0_l in *; lra end
  | cbv beta; identity ].

(** What is affine in a field u, where the fact H states that [c t <= u]. *)
Ltac diverges_by H :=
  try (eapply tends_ext; [intros; apply Rplus_comm | apply diverges_affine; [positive |]]);
  match type of (H 1 Rle_0_1) with ?c <= _ => apply (diverges_above _ 0 c); [positive |] end;
  intros t Ht; pose proof (H t Ht) as P0; same_inequality P0.

(** What lies between two multiples of 1/s, by the fact H, where s diverges by the fact D. *)
Ltac squeezed_by H D :=
  match type of (H 0 (Rle_refl 0)) with context [_ <= ?B / _] => apply (squeezed _ _ B D) end;
  intros t Ht; pose proof (H t (Rlt_le _ _ Ht)); unfold Rdiv in *; lra.

(** A field that is bounded, part by part. *)
Ltac bounded_by_parts :=
  cbv beta; unfold Rdiv, Rminus; first [eassumption | apply bounded_const
    | first [apply bounded_plus | apply bounded_mult | apply bounded_opp]; bounded_by_parts].

(** The drift that the fact H gives, with a load of which mean and period are known. *)
Ltac drifts_by H :=
  lazymatch goal with C : continuous_in_time ?U, M : ?m = RInt _ 0 ?T / ?T |- _ =>
    lazymatch type of H with tends (fun t => t * (Derive ?u t - ?r) - @?A t) 0 =>
      let e := eval cbv beta in (A 0) in lazymatch eval pattern (U 0) in e with ?a _ =>
        apply (tends_value _ (a m)); [cbv beta; field; positive |];
        apply (tends_ext (fun t => (u t - r * t) / ln (t / T)));
          [intros t Ht; unfold Rdiv; f_equal; field; positive |];
        apply (logarithmic_drift u U a); first [assumption | exact H | intro; field; positive]
    end end end.

(** An equation E about a field u is one about any value of it, if it is an identity. *)
Ltac of_any_value u E :=
  let P := type of (E 0 (Rle_refl 0)) in match eval pattern (u 0) in P with ?Q _ =>
    let any := eval cbv beta in (forall x, Q x) in assert any by (intro; identity) end.

(** A rate F(u, a), by the fact H, that rises with the bounded load a and is positive at its lower
    bound, for all u where P holds. *)
Ltac unbounded_where P H :=
  let told x := try match goal with E : forall y : R, _ = _ |- _ => pose proof (E x) end in
  match goal with B : forall t, 0 <= t -> Rabs (?a t) <= ?U |- diverges (fun t => ?u t) =>
    match type of (H 0 (Rle_refl 0)) with _ = ?e =>
    match eval pattern (u 0), (a 0) in e with ?F _ _ =>
      apply (unbounded u a F (- U) P); [assumption | exact H | | auto | intros; lra + exact I | |];
      [ intros t Ht; told (u t); specialize (B t Ht); apply Rabs_le_between in B;
        try match goal with G : forall t, _ -> 0 <= u t |- _ => known (G t Ht) end; nondecreasing
      | intros x least; told x; arithmetic
      | intros x least; told x; positive_sums; auto_derive; repeat split; positive ] end end end.

Ltac unbounded_by H :=
  first [unbounded_where (fun x => 0 <= x) H | unbounded_where (fun _ : R => True) H].

(** The change of tanh between two arguments: not negative, and at most that of the arguments. *)
Ltac increase_of_tanh :=
  at_two tanh ltac:(fun a b =>
    let D := fresh in assert (D : a <= b) by (apply Rminus_le_0; ring_simplify; positive);
    pose proof (tanh_order _ _ D); pose proof (tanh_slope _ _ D));
  split; nra.
