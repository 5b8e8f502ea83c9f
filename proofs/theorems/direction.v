(* The first three derivatives of a unit vector along an affine path, `bound::direction`.

   N, L and O move as V (1 + z t) in the plane of V and V_x, from any point on: z = a + b i there, p >= |b| and q >= |z|. In
   that plane the direction is (c t, s t). By hand: a rotation of space takes that plane to this one and keeps all lengths. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(* The derivatives of (c, s) = (cos, sin) of an angle of speed w. *)
Section Angle.
Variables c s w w1 w2 : R -> R.
Variable t : R.
Hypothesis dc : is_derive c t (- w t * s t).
Hypothesis ds : is_derive s t (w t * c t).
Hypothesis dw : is_derive w t (w1 t).
Hypothesis dw1 : is_derive w1 t (w2 t).
Definition c1 u := - w u * s u.
Definition s1 u := w u * c u.
Definition c2 u := - w1 u * s u - w u * w u * c u.
Definition s2 u := w1 u * c u - w u * w u * s u.
Definition c3 u := - w2 u * s u - 3 * w u * w1 u * c u + w u * w u * w u * s u.
Definition s3 u := w2 u * c u - 3 * w u * w1 u * s u - w u * w u * w u * c u.

Lemma product f g f' g' : is_derive f t f' -> is_derive g t g' -> is_derive (fun u => f u * g u) t (f' * g t + f t * g').
Proof. intros F G. apply (is_derive_mult f g); [exact F | exact G | exact Rmult_comm]. Qed.

Lemma second : is_derive c1 t (c2 t) /\ is_derive s1 t (s2 t).
Proof.
split.
- replace (c2 t) with (- w1 t * s t + - w t * (w t * c t)) by (unfold c2; ring).
  apply (product (fun u => - w u) s); [apply (is_derive_opp w), dw | exact ds].
- replace (s2 t) with (w1 t * c t + w t * (- w t * s t)) by (unfold s2; ring).
  apply (product w c); [exact dw | exact dc].
Qed.

Lemma third : is_derive c2 t (c3 t) /\ is_derive s2 t (s3 t).
Proof.
assert (WW := product w w _ _ dw dw). split.
- replace (c3 t) with ((- w2 t * s t + - w1 t * (w t * c t)) - ((w1 t * w t + w t * w1 t) * c t + w t * w t * (- w t * s t)))
    by (unfold c3; ring).
  apply (is_derive_minus (fun u => - w1 u * s u) (fun u => w u * w u * c u)).
  + apply (product (fun u => - w1 u) s); [apply (is_derive_opp w1), dw1 | exact ds].
  + apply (product (fun u => w u * w u) c); [exact WW | exact dc].
- replace (s3 t) with ((w2 t * c t + w1 t * (- w t * s t)) - ((w1 t * w t + w t * w1 t) * s t + w t * w t * (w t * c t)))
    by (unfold s3; ring).
  apply (is_derive_minus (fun u => w1 u * c u) (fun u => w u * w u * s u)).
  + apply (product w1 c); [exact dw1 | exact dc].
  + apply (product (fun u => w u * w u) s); [exact WW | exact ds].
Qed.
End Angle.

Section Direction.
Variables a b : R.
Definition n t := (1 + a * t) * (1 + a * t) + b * t * (b * t).
Definition c t := (1 + a * t) / sqrt (n t).
Definition s t := b * t / sqrt (n t).
(* The speed of the angle, and its derivatives. *)
Definition w t := b / n t.
Definition n1 t := 2 * (a * (1 + a * t) + b * (b * t)).
Definition w1 t := - b * n1 t / (n t * n t).
Definition w2 t := - b * (2 * (a * a + b * b) * n t - 2 * n1 t * n1 t) / (n t * n t * n t).

Lemma speed t : 0 < n t -> is_derive w t (w1 t) /\ is_derive w1 t (w2 t).
Proof.
intros N. assert (E : n t <> 0) by lra.
split; [unfold w, w1 | unfold w1, w2]; unfold n1, n in *; auto_derive; try exact E; try (intro Z; nra); try field; try exact E.
Qed.

Lemma turn t : 0 < n t -> is_derive c t (- w t * s t) /\ is_derive s t (w t * c t).
Proof.
intros N. assert (S := sqrt_lt_R0 _ N). assert (Q := sqrt_sqrt (n t) (Rlt_le _ _ N)).
assert (D : is_derive (fun t => sqrt (n t)) t (n1 t / (2 * sqrt (n t)))).
{ unfold n1, n in *. auto_derive; [exact N | field; lra]. }
split.
- replace (- w t * s t) with ((a * sqrt (n t) - (1 + a * t) * (n1 t / (2 * sqrt (n t)))) / sqrt (n t) ^ 2).
  + apply (is_derive_div (fun u => 1 + a * u) (fun u => sqrt (n u)) t a (n1 t / (2 * sqrt (n t)))).
    * auto_derive; [exact I | ring].
    * exact D.
    * lra.
  + unfold w, s. set (q := sqrt (n t)) in *.
    transitivity ((a * (q * q) - (1 + a * t) * (n1 t / 2)) / (q * q * q)); [field; lra|]. rewrite Q.
    transitivity (- (b * (b * t)) / (n t * q)); [|field; lra].
    f_equal. unfold n1, n. field.
- replace (w t * c t) with ((b * sqrt (n t) - b * t * (n1 t / (2 * sqrt (n t)))) / sqrt (n t) ^ 2).
  + apply (is_derive_div (fun u => b * u) (fun u => sqrt (n u)) t b (n1 t / (2 * sqrt (n t)))).
    * auto_derive; [exact I | ring].
    * exact D.
    * lra.
  + unfold w, c. set (q := sqrt (n t)) in *.
    transitivity ((b * (q * q) - b * t * (n1 t / 2)) / (q * q * q)); [field; lra|]. rewrite Q.
    transitivity (b * (1 + a * t) / (n t * q)); [|field; lra].
    f_equal. unfold n1, n. field.
Qed.

Lemma at_zero : c 0 = 1 /\ s 0 = 0 /\ w 0 = b /\ w1 0 = - 2 * a * b /\ w2 0 = 2 * b * (3 * (a * a) - b * b).
Proof.
assert (N : n 0 = 1) by (unfold n; ring).
unfold c, s, w, w1, w2. rewrite N, sqrt_1. unfold n1. repeat split; field.
Qed.

(* Bounds, as squares of lengths. *)
Variables p q : R.
Hypothesis p_is : Rabs b <= p.
Hypothesis q_is : a * a + b * b <= q * q.
Hypothesis q_pos : 0 <= q.

Let squares : b * b <= p * p /\ 0 <= p.
Proof. generalize (Rabs_pos b) p_is (Rsqr_abs b). unfold Rsqr. nra. Qed.

Theorem first_bound : c1 s w 0 ^ 2 + s1 c w 0 ^ 2 <= p ^ 2.
Proof. destruct at_zero as [C [S [W _]]]. unfold c1, s1. rewrite C, S, W. nra. Qed.

Theorem second_bound : c2 c s w w1 0 ^ 2 + s2 c s w w1 0 ^ 2 <= Rmin ((2 * p * q) ^ 2) (4 / 3 * q ^ 4).
Proof.
destruct at_zero as [C [S [W [W1 _]]]]. unfold c2, s2. rewrite C, S, W, W1.
replace ((- (-2 * a * b) * 0 - b * b * 1) ^ 2 + (-2 * a * b * 1 - b * b * 0) ^ 2) with (b * b * (4 * (a * a) + b * b)) by ring.
apply Rmin_glb.
- replace ((2 * p * q) ^ 2) with (p * p * (4 * (q * q))) by ring. apply Rmult_le_compat; nra.
- replace (4 / 3 * q ^ 4) with (4 / 3 * ((q * q) * (q * q))) by ring.
  set (u := b * b) in *. set (v := a * a) in *. set (z := q * q) in *.
  assert (0 <= u) by apply Rle_0_sqr. assert (0 <= v) by apply Rle_0_sqr.
  assert ((v + u) * (v + u) <= z * z) by (apply Rmult_le_compat; lra).
  assert (0 <= (v - u / 2) * (v - u / 2)) by apply Rle_0_sqr. nra.
Qed.

Theorem third_bound : c3 c s w w1 w2 0 ^ 2 + s3 c s w w1 w2 0 ^ 2 <= Rmin ((6 * p * q ^ 2) ^ 2) ((3 * q ^ 3) ^ 2).
Proof.
destruct at_zero as [C [S [W [W1 W2]]]]. unfold c3, s3. rewrite C, S, W, W1, W2.
match goal with |- ?l <= _ => replace l with (9 * (b * b) * (4 * (a * a) * (a * a) + b * b * (b * b))) by ring end.
set (u := b * b) in *. set (v := a * a) in *.
assert (0 <= u) by apply Rle_0_sqr. assert (0 <= v) by apply Rle_0_sqr.
assert (Z : (v + u) * (v + u) <= q * q * (q * q)) by (apply Rmult_le_compat; lra).
apply Rmin_glb.
- replace ((6 * p * q ^ 2) ^ 2) with (36 * ((p * p) * ((q * q) * (q * q)))) by ring.
  replace (9 * u * (4 * v * v + u * u)) with (36 * (u * (v * v + u * u / 4))) by field.
  apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat; nra.
- replace ((3 * q ^ 3) ^ 2) with (9 * ((q * q) * ((q * q) * (q * q)))) by ring.
  assert ((v + u) * ((v + u) * (v + u)) <= q * q * (q * q * (q * q))) by (apply Rmult_le_compat; nra).
  assert (0 <= v * ((v - u / 2) * (v - u / 2))) by (apply Rmult_le_pos; [lra | apply Rle_0_sqr]). nra.
Qed.

(* The half-turn about n, 2 n n^T - 1, has in that plane the columns (c2, s2) and (s2, - c2), the cosine and sine of twice the
   angle, and is constant across it: so its derivatives are as long as those of (c2, s2). *)
Definition cc t := c t * c t - s t * s t.
Definition ss t := 2 * (c t * s t).
Definition ww t := 2 * w t.
Definition ww1 t := 2 * w1 t.
Definition ww2 t := 2 * w2 t.

Lemma double t : 0 < n t -> is_derive cc t (- ww t * ss t) /\ is_derive ss t (ww t * cc t).
Proof.
intros N. destruct (turn t N) as [C S]. split.
- replace (- ww t * ss t) with ((- w t * s t * c t + c t * (- w t * s t)) - (w t * c t * s t + s t * (w t * c t))) by (unfold ww, ss; ring).
  apply (is_derive_minus (fun u => c u * c u) (fun u => s u * s u)); apply product; assumption.
- replace (ww t * cc t) with (scal 2 (- w t * s t * s t + c t * (w t * c t))) by (unfold ww, cc, scal; simpl; unfold mult; simpl; ring).
  apply (is_derive_scal (fun u => c u * s u)); apply product; assumption.
Qed.

Theorem half_turn_bounds :
  c1 ss ww 0 ^ 2 + s1 cc ww 0 ^ 2 <= (2 * p) ^ 2 /\
  c2 cc ss ww ww1 0 ^ 2 + s2 cc ss ww ww1 0 ^ 2 <= (4 * p * q) ^ 2 /\
  c3 cc ss ww ww1 ww2 0 ^ 2 + s3 cc ss ww ww1 ww2 0 ^ 2 <= (12 * p * q ^ 2) ^ 2.
Proof.
destruct at_zero as [C [S [W [W1 W2]]]]. unfold c1, s1, c2, s2, c3, s3, cc, ss, ww, ww1, ww2. rewrite C, S, W, W1, W2.
assert (Z : (a * a + b * b) * (a * a + b * b) <= q * q * (q * q)) by (apply Rmult_le_compat; nra).
destruct squares as [P _]. assert (B : 0 <= b * b) by apply Rle_0_sqr. repeat split.
- nra.
- match goal with |- ?l <= _ => replace l with (16 * (b * b * (a * a + b * b))) by ring end.
  replace ((4 * p * q) ^ 2) with (16 * (p * p * (q * q))) by ring. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat; nra.
- match goal with |- ?l <= _ => replace l with (144 * (b * b * ((a * a + b * b) * (a * a + b * b)))) by ring end.
  replace ((12 * p * q ^ 2) ^ 2) with (144 * (p * p * (q * q * (q * q)))) by ring.
  apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat; nra.
Qed.
End Direction.
