(* Products of unit vectors and the power of a highlight, `bound::product` and `Highlight::error`.
   Vectors have three components. at_most v m says that v is at most m long. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Record vec := V { X : R; Y : R; Z : R }.
Definition dot u v := X u * X v + Y u * Y v + Z u * Z v.
Definition at_most (u : vec) m := 0 <= m /\ dot u u <= m * m.
Definition derives (f f' : R -> vec) t :=
  is_derive (fun t => X (f t)) t (X (f' t)) /\ is_derive (fun t => Y (f t)) t (Y (f' t)) /\
  is_derive (fun t => Z (f t)) t (Z (f' t)).

Lemma lagrange u v : dot u v * dot u v <= dot u u * dot v v.
Proof.
destruct u as [a b c], v as [x y z]. unfold dot; simpl.
assert (0 <= (a * y - b * x) * (a * y - b * x)) by apply Rle_0_sqr.
assert (0 <= (a * z - c * x) * (a * z - c * x)) by apply Rle_0_sqr.
assert (0 <= (b * z - c * y) * (b * z - c * y)) by apply Rle_0_sqr. nra.
Qed.

Lemma cauchy u v a b : at_most u a -> at_most v b -> Rabs (dot u v) <= a * b.
Proof.
intros [A U] [B W]. rewrite <- (Rabs_pos_eq (a * b)) by (apply Rmult_le_pos; assumption).
apply Rsqr_le_abs_0. unfold Rsqr. assert (L := lagrange u v).
assert (D : forall w, 0 <= dot w w) by (intros [x y z]; unfold dot; simpl; nra).
assert (dot u u * dot v v <= a * a * (b * b)) by (apply Rmult_le_compat; auto). nra.
Qed.

Lemma is_product f g f' g' t : is_derive f t f' -> is_derive g t g' -> is_derive (fun u => f u * g u) t (f' * g t + f t * g').
Proof. intros F G. apply (is_derive_mult f g); [exact F | exact G | exact Rmult_comm]. Qed.

Lemma d_dot f f' g g' t : derives f f' t -> derives g g' t ->
  is_derive (fun t => dot (f t) (g t)) t (dot (f' t) (g t) + dot (f t) (g' t)).
Proof.
intros [FX [FY FZ]] [GX [GY GZ]]. unfold dot.
replace (X (f' t) * X (g t) + Y (f' t) * Y (g t) + Z (f' t) * Z (g t) + (X (f t) * X (g' t) + Y (f t) * Y (g' t) + Z (f t) * Z (g' t)))
  with (X (f' t) * X (g t) + X (f t) * X (g' t) + (Y (f' t) * Y (g t) + Y (f t) * Y (g' t)) + (Z (f' t) * Z (g t) + Z (f t) * Z (g' t))) by ring.
apply (is_derive_plus (fun t => X (f t) * X (g t) + Y (f t) * Y (g t)) (fun t => Z (f t) * Z (g t))).
- apply (is_derive_plus (fun t => X (f t) * X (g t)) (fun t => Y (f t) * Y (g t))); apply is_product; assumption.
- apply is_product; assumption.
Qed.

Section Leibniz.
Variables f f1 f2 f3 g g1 g2 g3 : R -> vec.
Hypothesis df : forall t, derives f f1 t /\ derives f1 f2 t /\ derives f2 f3 t.
Hypothesis dg : forall t, derives g g1 t /\ derives g1 g2 t /\ derives g2 g3 t.
Definition p1 t := dot (f1 t) (g t) + dot (f t) (g1 t).
Definition p2 t := dot (f2 t) (g t) + 2 * dot (f1 t) (g1 t) + dot (f t) (g2 t).
Definition p3 t := dot (f3 t) (g t) + 3 * dot (f2 t) (g1 t) + 3 * dot (f1 t) (g2 t) + dot (f t) (g3 t).

Theorem leibniz t : is_derive (fun t => dot (f t) (g t)) t (p1 t) /\ is_derive p1 t (p2 t) /\ is_derive p2 t (p3 t).
Proof.
destruct (df t) as [F [F1 F2]]. destruct (dg t) as [G [G1 G2]]. refine (conj _ (conj _ _)).
- apply d_dot; assumption.
- replace (p2 t) with (dot (f2 t) (g t) + dot (f1 t) (g1 t) + (dot (f1 t) (g1 t) + dot (f t) (g2 t))) by (unfold p2; ring).
  apply (is_derive_plus (fun t => dot (f1 t) (g t)) (fun t => dot (f t) (g1 t))); apply d_dot; assumption.
- replace (p3 t) with (dot (f3 t) (g t) + dot (f2 t) (g1 t) + 2 * (dot (f2 t) (g1 t) + dot (f1 t) (g2 t))
    + (dot (f1 t) (g2 t) + dot (f t) (g3 t))) by (unfold p3; ring).
  apply (is_derive_plus (fun t => dot (f2 t) (g t) + 2 * dot (f1 t) (g1 t)) (fun t => dot (f t) (g2 t))); [|apply d_dot; assumption].
  apply (is_derive_plus (fun t => dot (f2 t) (g t)) (fun t => 2 * dot (f1 t) (g1 t))); [apply d_dot; assumption|].
  apply (is_derive_scal (fun t => dot (f1 t) (g1 t))). apply d_dot; assumption.
Qed.

Theorem leibniz_bound t a1 a2 a3 b1 b2 b3 :
  at_most (f t) 1 -> at_most (f1 t) a1 -> at_most (f2 t) a2 -> at_most (f3 t) a3 ->
  at_most (g t) 1 -> at_most (g1 t) b1 -> at_most (g2 t) b2 -> at_most (g3 t) b3 ->
  Rabs (p3 t) <= a3 + (a2 * b1 + a1 * b2) * 3 + b3.
Proof.
intros F F1 F2 F3 G G1 G2 G3. unfold p3.
assert (A := cauchy _ _ _ _ F3 G). assert (B := cauchy _ _ _ _ F2 G1).
assert (C := cauchy _ _ _ _ F1 G2). assert (D := cauchy _ _ _ _ F G3).
apply Rabs_le_between in A. apply Rabs_le_between in B. apply Rabs_le_between in C. apply Rabs_le_between in D.
apply Rabs_le. lra.
Qed.
End Leibniz.

(* s = 1 - |e|^2 / 2, e = r - o: its derivatives are those of Leibniz' rule for e and e. *)
Theorem cosine e e1 e2 e3 : (forall t, derives e e1 t /\ derives e1 e2 t /\ derives e2 e3 t) -> forall t : R,
  let s t := 1 - dot (e t) (e t) / 2 in
  let s1 t := - dot (e t) (e1 t) in
  let s2 t := - dot (e1 t) (e1 t) - dot (e t) (e2 t) in
  let s3 t := - 3 * dot (e1 t) (e2 t) - dot (e t) (e3 t) in
  is_derive s t (s1 t) /\ is_derive s1 t (s2 t) /\ is_derive s2 t (s3 t).
Proof.
intros H t s s1 s2 s3. destruct (H t) as [E [E1 E2]].
assert (S : forall u v, dot u v = dot v u) by (intros [a b c] [x y z]; unfold dot; simpl; ring).
refine (conj _ (conj _ _)).
- assert (Q : s1 t = 0 - / 2 * (dot (e1 t) (e t) + dot (e t) (e1 t))) by (unfold s1; rewrite (S (e1 t) (e t)); field). rewrite Q. unfold s.
  apply (is_derive_minus (fun _ => 1) (fun t => dot (e t) (e t) / 2)); [apply (is_derive_const 1)|].
  apply (is_derive_ext (fun t => / 2 * dot (e t) (e t))); [intro u; apply Rmult_comm|].
  apply (is_derive_scal (fun t => dot (e t) (e t))). apply d_dot; assumption.
- replace (s2 t) with (- (dot (e1 t) (e1 t) + dot (e t) (e2 t))) by (unfold s2; ring).
  apply (is_derive_opp (fun t => dot (e t) (e1 t))). apply d_dot; assumption.
- replace (s3 t) with (- (dot (e2 t) (e1 t) + dot (e1 t) (e2 t)) - (dot (e1 t) (e2 t) + dot (e t) (e3 t)))
    by (unfold s3; rewrite (S (e2 t) (e1 t)); ring).
  apply (is_derive_minus (fun t => - dot (e1 t) (e1 t)) (fun t => dot (e t) (e2 t))); [|apply d_dot; assumption].
  apply (is_derive_opp (fun t => dot (e1 t) (e1 t))). apply d_dot; assumption.
Qed.

(* s^rho for s > 0. *)
Lemma d_power s s' k t : 0 < s t -> is_derive s t s' -> is_derive (fun t => Rpower (s t) k) t (k * Rpower (s t) (k - 1) * s').
Proof.
intros P D. rewrite Rmult_comm.
apply (is_derive_comp (fun x => Rpower x k) s t (k * Rpower (s t) (k - 1)) s'); [|exact D].
apply is_derive_Reals, derivable_pt_lim_power, P.
Qed.

Theorem power s s1 s2 s3 k : (forall t, 0 < s t /\ is_derive s t (s1 t) /\ is_derive s1 t (s2 t) /\ is_derive s2 t (s3 t)) ->
  let q1 t := k * Rpower (s t) (k - 1) * s1 t in
  let q2 t := k * Rpower (s t) (k - 1) * s2 t + k * (k - 1) * Rpower (s t) (k - 2) * (s1 t * s1 t) in
  let q3 t := k * Rpower (s t) (k - 1) * s3 t + 3 * (k * (k - 1)) * Rpower (s t) (k - 2) * (s1 t * s2 t)
    + k * (k - 1) * (k - 2) * Rpower (s t) (k - 3) * (s1 t * s1 t * s1 t) in
  forall t : R, is_derive (fun t => Rpower (s t) k) t (q1 t) /\ is_derive q1 t (q2 t) /\ is_derive q2 t (q3 t).
Proof.
intros H q1 q2 q3 t. destruct (H t) as [P [D [D1 D2]]].
assert (E : forall j, is_derive (fun t => Rpower (s t) j) t (j * Rpower (s t) (j - 1) * s1 t)) by (intro j; apply d_power; assumption).
assert (E1 := E (k - 1)). assert (E2 := E (k - 2)).
replace (k - 1 - 1) with (k - 2) in E1 by ring. replace (k - 2 - 1) with (k - 3) in E2 by ring.
assert (S : forall c f f', is_derive f t f' -> is_derive (fun t => c * f t) t (c * f')) by (intros c f f'; apply (is_derive_scal f)).
refine (conj _ (conj _ _)).
- apply E.
- replace (q2 t) with (k * ((k - 1) * Rpower (s t) (k - 2) * s1 t) * s1 t + k * Rpower (s t) (k - 1) * s2 t) by (unfold q2; ring).
  apply (is_product (fun t => k * Rpower (s t) (k - 1)) s1); [apply S, E1 | exact D1].
- replace (q3 t) with (k * ((k - 1) * Rpower (s t) (k - 2) * s1 t) * s2 t + k * Rpower (s t) (k - 1) * s3 t
    + (k * (k - 1) * ((k - 2) * Rpower (s t) (k - 3) * s1 t) * (s1 t * s1 t)
    + k * (k - 1) * Rpower (s t) (k - 2) * (s2 t * s1 t + s1 t * s2 t))) by (unfold q3; ring).
  apply (is_derive_plus (fun t => k * Rpower (s t) (k - 1) * s2 t) (fun t => k * (k - 1) * Rpower (s t) (k - 2) * (s1 t * s1 t))).
  + apply (is_product (fun t => k * Rpower (s t) (k - 1)) s2); [apply S, E1 | exact D2].
  + apply (is_product (fun t => k * (k - 1) * Rpower (s t) (k - 2)) (fun t => s1 t * s1 t)); [apply S, E2 | apply is_product; exact D1].
Qed.

(* ln s for s > 0. *)
Theorem logarithm s s1 s2 s3 : (forall t, 0 < s t /\ is_derive s t (s1 t) /\ is_derive s1 t (s2 t) /\ is_derive s2 t (s3 t)) ->
  let q1 t := / s t * s1 t in
  let q2 t := / s t * s2 t - / s t * / s t * (s1 t * s1 t) in
  let q3 t := / s t * s3 t + - 3 * (/ s t * / s t) * (s1 t * s2 t) + 2 * (/ s t * / s t * / s t) * (s1 t * s1 t * s1 t) in
  forall t : R, is_derive (fun t => ln (s t)) t (q1 t) /\ is_derive q1 t (q2 t) /\ is_derive q2 t (q3 t).
Proof.
intros H q1 q2 q3 t. destruct (H t) as [P [D [D1 D2]]].
assert (I : is_derive (fun t => / s t) t (- (/ s t * / s t) * s1 t)).
{ replace (- (/ s t * / s t) * s1 t) with (- s1 t / (s t) ^ 2) by (field; lra). apply (is_derive_inv s t (s1 t)); [exact D | lra]. }
refine (conj _ (conj _ _)).
- replace (q1 t) with (s1 t * / s t) by apply Rmult_comm. apply (is_derive_comp ln s t (/ s t) (s1 t)); [|exact D].
  apply is_derive_Reals, derivable_pt_lim_ln, P.
- replace (q2 t) with (- (/ s t * / s t) * s1 t * s1 t + / s t * s2 t) by (unfold q2; ring).
  apply (is_product (fun t => / s t) s1); [exact I | exact D1].
- replace (q3 t) with (- (/ s t * / s t) * s1 t * s2 t + / s t * s3 t
    - ((- (/ s t * / s t) * s1 t * / s t + / s t * (- (/ s t * / s t) * s1 t)) * (s1 t * s1 t)
    + / s t * / s t * (s2 t * s1 t + s1 t * s2 t))) by (unfold q3; ring).
  apply (is_derive_minus (fun t => / s t * s2 t) (fun t => / s t * / s t * (s1 t * s1 t))).
  + apply (is_product (fun t => / s t) s2); [exact I | exact D2].
  + apply (is_product (fun t => / s t * / s t) (fun t => s1 t * s1 t));
      [apply (is_product (fun t => / s t) (fun t => / s t)) | apply (is_product s1 s1)]; assumption.
Qed.

(* A derivative of a unit vector o is perpendicular to it: |o'.r| <= |o'| sin(theta), cos(theta) = o.r. *)
Theorem perpendicular o o1 r m sine : dot o o = 1 -> dot r r = 1 -> dot o o1 = 0 -> at_most o1 m ->
  0 <= sine -> 1 - dot o r * dot o r <= sine * sine -> Rabs (dot o1 r) <= m * sine.
Proof.
intros O R P M S H.
set (v := V (X r - dot o r * X o) (Y r - dot o r * Y o) (Z r - dot o r * Z o)).
replace (dot o1 r) with (dot o1 v).
- apply cauchy; [exact M|]. split; [exact S|].
  replace (dot v v) with (dot r r - 2 * (dot o r * dot o r) + dot o r * dot o r * dot o o) by (unfold v, dot; simpl; ring).
  rewrite O, R. lra.
- replace (dot o1 v) with (dot o1 r - dot o r * dot o o1) by (unfold v, dot; simpl; ring). rewrite P. ring.
Qed.

(* The third derivative of s^rho from rho = 2 on: two of its terms have opposite signs. x, y, z stand for rho s^(rho-1),
   3 rho (rho-1) s^(rho-2) and rho (rho-1) (rho-2) s^(rho-3); u = |e'|^2 and v = e.e''. *)
Theorem highlight x y z s1 s3 u v sine c e1 e2 e3 :
  0 <= x -> 0 <= y -> 0 <= z -> 0 <= sine -> 0 <= c -> 0 <= e1 -> 0 <= e2 -> 0 <= e3 ->
  Rabs s1 <= e1 * sine -> Rabs s3 <= 3 * e1 * e2 + c * e3 -> 0 <= u <= e1 * e1 -> Rabs v <= c * e2 ->
  Rabs (x * s3 + y * (s1 * (- u - v)) + z * (s1 * s1 * s1))
  <= x * (3 * e1 * e2 + c * e3) + y * sine * c * e1 * e2 + Rmax (y * sine) (z * (sine * sine * sine)) * (e1 * e1 * e1).
Proof.
intros x0 y0 z0 sine0 c0 e10 e20 e30 S1 S3 [u0 U] V'.
assert (A : Rabs (x * s3) <= x * (3 * e1 * e2 + c * e3)).
{ rewrite Rabs_mult, (Rabs_pos_eq x x0). apply Rmult_le_compat_l; assumption. }
assert (B : Rabs (y * (s1 * v)) <= y * sine * c * e1 * e2).
{ rewrite !Rabs_mult, (Rabs_pos_eq y y0). replace (y * sine * c * e1 * e2) with (y * (e1 * sine * (c * e2))) by ring.
  apply Rmult_le_compat_l; [assumption|]. apply Rmult_le_compat; auto using Rabs_pos. }
assert (C : Rabs (z * (s1 * s1 * s1) - y * (s1 * u)) <= Rmax (y * sine) (z * (sine * sine * sine)) * (e1 * e1 * e1)).
{ set (k := e1 * sine) in *. assert (K : 0 <= k) by (apply Rmult_le_pos; assumption).
  assert (E3 : 0 <= e1 * e1 * e1) by (repeat apply Rmult_le_pos; assumption).
  assert (P : y * (k * (e1 * e1)) <= Rmax (y * sine) (z * (sine * sine * sine)) * (e1 * e1 * e1)).
  { replace (y * (k * (e1 * e1))) with (y * sine * (e1 * e1 * e1)) by (unfold k; ring). apply Rmult_le_compat_r; [exact E3 | apply Rmax_l]. }
  assert (Q : z * (k * k * k) <= Rmax (y * sine) (z * (sine * sine * sine)) * (e1 * e1 * e1)).
  { replace (z * (k * k * k)) with (z * (sine * sine * sine) * (e1 * e1 * e1)) by (unfold k; ring).
    apply Rmult_le_compat_r; [exact E3 | apply Rmax_r]. }
  assert (T : forall w, 0 <= w <= k -> 0 <= z * (w * w * w) <= z * (k * k * k) /\ 0 <= y * (w * u) <= y * (k * (e1 * e1))).
  { intros w [W WK]. assert (w * w <= k * k) by (apply Rmult_le_compat; assumption).
    assert (0 <= w * w) by (apply Rmult_le_pos; assumption).
    repeat split; try (repeat apply Rmult_le_pos; assumption); apply Rmult_le_compat_l; try assumption; apply Rmult_le_compat; assumption. }
  apply Rabs_le. destruct (Rle_dec 0 s1).
  - rewrite Rabs_pos_eq in S1 by assumption. destruct (T s1 (conj r S1)). lra.
  - rewrite Rabs_left in S1 by lra. destruct (T (- s1)) as [F G]; [lra|].
    replace (s1 * s1 * s1) with (- (- s1 * - s1 * - s1)) by ring. replace (s1 * u) with (- (- s1 * u)) by ring. lra. }
replace (x * s3 + y * (s1 * (- u - v)) + z * (s1 * s1 * s1))
  with (x * s3 + - (y * (s1 * v)) + (z * (s1 * s1 * s1) - y * (s1 * u))) by ring.
eapply Rle_trans; [apply Rabs_triang|]. apply Rplus_le_compat; [|exact C].
eapply Rle_trans; [apply Rabs_triang|]. rewrite Rabs_Ropp. lra.
Qed.

(* For any rho, also below 2, where the signs of y and z are others. *)
Theorem highlight_below_2 x y z s1 s3 u v sine c e1 e2 e3 :
  0 <= x -> 0 <= sine -> 0 <= c -> 0 <= e1 -> 0 <= e2 -> 0 <= e3 ->
  Rabs s1 <= e1 * sine -> Rabs s3 <= 3 * e1 * e2 + c * e3 -> 0 <= u <= e1 * e1 -> Rabs v <= c * e2 ->
  Rabs (x * s3 + y * (s1 * (- u - v)) + z * (s1 * s1 * s1))
  <= x * (3 * e1 * e2 + c * e3) + Rabs y * sine * c * e1 * e2
    + (Rabs y * sine + Rabs z * (sine * sine * sine)) * (e1 * e1 * e1).
Proof.
intros x0 sine0 c0 e10 e20 e30 S1 S3 [u0 U] V'.
assert (K : 0 <= e1 * sine) by (apply Rmult_le_pos; assumption).
assert (A : Rabs (x * s3) <= x * (3 * e1 * e2 + c * e3)).
{ rewrite Rabs_mult, (Rabs_pos_eq x x0). apply Rmult_le_compat_l; assumption. }
assert (B : Rabs (y * (s1 * (- u - v))) <= Rabs y * (e1 * sine * (e1 * e1 + c * e2))).
{ rewrite 2!Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|]. apply Rmult_le_compat; auto using Rabs_pos.
  apply Rabs_le_between in V'. apply Rabs_le. lra. }
assert (C : Rabs (z * (s1 * s1 * s1)) <= Rabs z * (e1 * sine * (e1 * sine) * (e1 * sine))).
{ rewrite !Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|].
  repeat apply Rmult_le_compat; auto using Rabs_pos. apply Rmult_le_pos; apply Rabs_pos. }
eapply Rle_trans; [apply Rabs_triang|]. eapply Rle_trans; [apply Rplus_le_compat_r, Rabs_triang|]. lra.
Qed.

(* The third derivative of ln s: k stands for 1 / s, at most m. *)
Theorem logarithm_bound k m s1 s3 u v sine c e1 e2 e3 :
  0 <= k <= m -> 0 <= sine -> 0 <= c -> 0 <= e1 -> 0 <= e2 -> 0 <= e3 ->
  Rabs s1 <= e1 * sine -> Rabs s3 <= 3 * e1 * e2 + c * e3 -> 0 <= u <= e1 * e1 -> Rabs v <= c * e2 ->
  Rabs (k * s3 + - 3 * (k * k) * (s1 * (- u - v)) + 2 * (k * k * k) * (s1 * s1 * s1))
  <= m * (3 * e1 * e2 + c * e3) + 3 * (m * m) * sine * c * e1 * e2
    + (3 * (m * m) * sine + 2 * (m * m * m) * (sine * sine * sine)) * (e1 * e1 * e1).
Proof.
intros [k0 K] sine0 c0 e10 e20 e30 S1 S3 U V'.
assert (m0 : 0 <= m) by lra.
assert (K2 : k * k <= m * m) by (apply Rmult_le_compat; assumption).
assert (k20 : 0 <= k * k) by (apply Rmult_le_pos; assumption).
assert (K3 : k * k * k <= m * m * m) by (apply Rmult_le_compat; assumption).
assert (k30 : 0 <= k * k * k) by (apply Rmult_le_pos; assumption).
eapply Rle_trans; [apply (highlight_below_2 k (- 3 * (k * k)) (2 * (k * k * k)) s1 s3 u v sine c e1 e2 e3); assumption|].
replace (- 3 * (k * k)) with (- (3 * (k * k))) by ring. rewrite Rabs_Ropp, !Rabs_pos_eq by (apply Rmult_le_pos; lra).
assert (A0 : 0 <= 3 * e1 * e2 + c * e3) by (apply Rle_trans with (Rabs s3); [apply Rabs_pos | exact S3]).
assert (B0 : 0 <= sine * c * e1 * e2) by (repeat apply Rmult_le_pos; assumption).
assert (C0 : 0 <= sine * (e1 * e1 * e1)) by (repeat apply Rmult_le_pos; assumption).
assert (D0 : 0 <= sine * sine * sine * (e1 * e1 * e1)) by (repeat apply Rmult_le_pos; assumption).
assert (A := Rmult_le_compat_r _ _ _ A0 K). assert (B := Rmult_le_compat_r _ _ _ B0 K2).
assert (C := Rmult_le_compat_r _ _ _ C0 K2). assert (D := Rmult_le_compat_r _ _ _ D0 K3). lra.
Qed.

(* An error of ln p, p = s^rho, of at most x < 1 makes an error of p of at most p x / (1 - x). *)
Theorem exponential p d x : 0 <= p -> Rabs d <= x < 1 -> Rabs (p * exp d - p) <= p * (x / (1 - x)).
Proof.
intros P [D X]. replace (p * exp d - p) with (p * (exp d - 1)) by ring.
rewrite Rabs_mult, (Rabs_pos_eq p P). apply Rmult_le_compat_l; [exact P|].
apply Rabs_le_between in D. assert (x0 : 0 <= x) by lra.
assert (L : 1 + d <= exp d) by (destruct (Req_dec d 0) as [->|N]; [rewrite exp_0; lra | left; apply exp_ineq1, N]).
assert (U : exp d * (1 - x) <= 1).
{ assert (N : 1 - d <= exp (- d)) by (destruct (Req_dec d 0) as [->|N]; [rewrite Ropp_0, exp_0; lra | left; apply exp_ineq1; lra]).
  assert (E : exp d * exp (- d) = 1) by (rewrite <- exp_plus; replace (d + - d) with 0 by ring; apply exp_0).
  assert (0 < exp d) by apply exp_pos. rewrite <- E. apply Rmult_le_compat_l; lra. }
assert (Q : x / (1 - x) = / (1 - x) - 1) by (field; lra).
assert (I : exp d <= / (1 - x)) by (apply (Rmult_le_reg_r (1 - x)); [lra|]; rewrite Rinv_l; lra).
apply Rabs_le. split; [|lra].
assert (x <= x / (1 - x)) by (apply (Rmult_le_reg_r (1 - x)); [lra|]; unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; nra). lra.
Qed.

(* Leibniz' rule for r = R l: R and its derivatives are matrices by rows, m u is at most c |u| long. *)
Record matrix := M { row1 : vec; row2 : vec; row3 : vec }.
Definition mul m u := V (dot (row1 m) u) (dot (row2 m) u) (dot (row3 m) u).
Definition add u v := V (X u + X v) (Y u + Y v) (Z u + Z v).
Definition scale k u := V (k * X u) (k * Y u) (k * Z u).
Definition stretches m c := 0 <= c /\ forall u a, at_most u a -> at_most (mul m u) (c * a).

Lemma add_at_most u v a b : at_most u a -> at_most v b -> at_most (add u v) (a + b).
Proof.
intros U W. assert (C := cauchy u v a b U W). apply Rabs_le_between in C. destruct U as [A U], W as [B W]. split; [lra|].
replace (dot (add u v) (add u v)) with (dot u u + 2 * dot u v + dot v v) by (unfold add, dot; simpl; ring). lra.
Qed.

Lemma scale_at_most k u a : 0 <= k -> at_most u a -> at_most (scale k u) (k * a).
Proof.
intros K [A U]. split; [apply Rmult_le_pos; assumption|].
replace (dot (scale k u) (scale k u)) with (k * k * dot u u) by (unfold scale, dot; simpl; ring).
replace (k * a * (k * a)) with (k * k * (a * a)) by ring. apply Rmult_le_compat_l; [apply Rle_0_sqr | exact U].
Qed.

Section Reflected.
Variables m m1 m2 m3 : R -> matrix.
Variables l l1 l2 l3 : R -> vec.
Hypothesis dl : forall t, derives l l1 t /\ derives l1 l2 t /\ derives l2 l3 t.
Hypothesis rows : forall row, row = row1 \/ row = row2 \/ row = row3 -> forall t,
  derives (fun t => row (m t)) (fun t => row (m1 t)) t /\ derives (fun t => row (m1 t)) (fun t => row (m2 t)) t /\
  derives (fun t => row (m2 t)) (fun t => row (m3 t)) t.
Definition r t := mul (m t) (l t).
Definition r3 t := add (add (mul (m3 t) (l t)) (scale 3 (mul (m2 t) (l1 t)))) (add (scale 3 (mul (m1 t) (l2 t))) (mul (m t) (l3 t))).

(* Each component of r has the third derivative of r3. *)
Theorem reflected t : exists r1 r2 : R -> vec, derives r r1 t /\ derives r1 r2 t /\ derives r2 r3 t.
Proof.
assert (D := fun row H => leibniz (fun t => row (m t)) (fun t => row (m1 t)) (fun t => row (m2 t)) (fun t => row (m3 t))
  l l1 l2 l3 (rows row H) dl t).
destruct (D row1 (or_introl eq_refl)) as [A [A1 A2]]. destruct (D row2 (or_intror (or_introl eq_refl))) as [B [B1 B2]].
destruct (D row3 (or_intror (or_intror eq_refl))) as [C [C1 C2]].
exists (fun t => V (p1 (fun t => row1 (m t)) (fun t => row1 (m1 t)) l l1 t)
  (p1 (fun t => row2 (m t)) (fun t => row2 (m1 t)) l l1 t) (p1 (fun t => row3 (m t)) (fun t => row3 (m1 t)) l l1 t)).
exists (fun t => V (p2 (fun t => row1 (m t)) (fun t => row1 (m1 t)) (fun t => row1 (m2 t)) l l1 l2 t)
  (p2 (fun t => row2 (m t)) (fun t => row2 (m1 t)) (fun t => row2 (m2 t)) l l1 l2 t)
  (p2 (fun t => row3 (m t)) (fun t => row3 (m1 t)) (fun t => row3 (m2 t)) l l1 l2 t)).
refine (conj (conj A (conj B C)) (conj (conj A1 (conj B1 C1)) _)).
unfold r3, add, scale, mul, derives; simpl. refine (conj _ (conj _ _)).
- replace (_ + _) with (p3 (fun t => row1 (m t)) (fun t => row1 (m1 t)) (fun t => row1 (m2 t)) (fun t => row1 (m3 t)) l l1 l2 l3 t) by (unfold p3; ring). exact A2.
- replace (_ + _) with (p3 (fun t => row2 (m t)) (fun t => row2 (m1 t)) (fun t => row2 (m2 t)) (fun t => row2 (m3 t)) l l1 l2 l3 t) by (unfold p3; ring). exact B2.
- replace (_ + _) with (p3 (fun t => row3 (m t)) (fun t => row3 (m1 t)) (fun t => row3 (m2 t)) (fun t => row3 (m3 t)) l l1 l2 l3 t) by (unfold p3; ring). exact C2.
Qed.

Theorem reflected_bound t a1 a2 a3 b1 b2 b3 :
  stretches (m t) 1 -> stretches (m1 t) a1 -> stretches (m2 t) a2 -> stretches (m3 t) a3 ->
  at_most (l t) 1 -> at_most (l1 t) b1 -> at_most (l2 t) b2 -> at_most (l3 t) b3 ->
  at_most (r3 t) (a3 + (a2 * b1 + a1 * b2) * 3 + b3).
Proof.
intros [_ A] [_ A1] [_ A2] [_ A3] B B1 B2 B3. unfold r3.
replace (a3 + (a2 * b1 + a1 * b2) * 3 + b3) with ((a3 * 1 + 3 * (a2 * b1)) + (3 * (a1 * b2) + 1 * b3)) by ring.
repeat apply add_at_most; auto; apply scale_at_most; auto; lra.
Qed.
End Reflected.
