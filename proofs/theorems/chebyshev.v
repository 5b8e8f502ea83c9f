(* The error of a biquadratic through nine samples, `bound::interpolation_error`.

   f is sampled on [-1, 1] x [-1, 1] at the nodes x, y in {-r, 0, r}, r = sqrt(3) / 2. Where its third derivatives along x
   and y are at most m and n, the interpolant errs by at most (m + n + 2/3 min(m, n)) / 24. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Definition r := sqrt 3 / 2.
Lemma r2 : r * r = 3 / 4.
Proof. unfold r. generalize (sqrt_sqrt 3). lra. Qed.
Lemma r_range : 0 < r < 1.
Proof. generalize r2. assert (0 < r) by (unfold r; generalize (sqrt_lt_R0 3); lra). nra. Qed.

(* The quadratic through three samples of g. *)
Definition through (g : R -> R) x :=
  g 0 + (g r - g (- r)) / (2 * r) * x + (g r + g (- r) - 2 * g 0) / (2 * r * r) * (x * x).

Definition derives (f f' : R -> R) := forall t, -1 <= t <= 1 -> is_derive f t (f' t).

Lemma rolle g g' a b : derives g g' -> -1 <= a -> a < b -> b <= 1 -> g a = 0 -> g b = 0 ->
  exists c, a < c < b /\ g' c = 0.
Proof.
intros D A H B Ga Gb. destruct (MVT_cor2 g g' a b H) as [c [E C]].
- intros t T. apply is_derive_Reals, D. lra.
- exists c. split; [exact C|]. rewrite Ga, Gb in E. apply Rmult_eq_reg_r with (b - a); lra.
Qed.

Lemma rolle3 g g1 g2 g3 a b c d : derives g g1 -> derives g1 g2 -> derives g2 g3 ->
  -1 <= a -> a < b -> b < c -> c < d -> d <= 1 -> g a = 0 -> g b = 0 -> g c = 0 -> g d = 0 ->
  exists t, -1 <= t <= 1 /\ g3 t = 0.
Proof.
intros D1 D2 D3 A B C D E Ga Gb Gc Gd.
destruct (rolle g g1 a b) as [p [P Gp]]; try lra; auto.
destruct (rolle g g1 b c) as [q [Q Gq]]; try lra; auto.
destruct (rolle g g1 c d) as [s [S Gs]]; try lra; auto.
destruct (rolle g1 g2 p q) as [u [U Gu]]; try lra; auto.
destruct (rolle g1 g2 q s) as [v [V Gv]]; try lra; auto.
destruct (rolle g2 g3 u v) as [t [T Gt]]; try lra; auto.
exists t. split; [lra | exact Gt].
Qed.

Lemma minus_quadratic f f' a b c k : derives f f' ->
  derives (fun t => f t - (a + b * t + c * (t * t) + k * (t * (t * t)))) (fun t => f' t - (b + 2 * c * t + 3 * k * (t * t))).
Proof.
intros D t T. apply (is_derive_minus f (fun t => a + b * t + c * (t * t) + k * (t * (t * t)))).
- apply D, T.
- auto_derive; [exact I | ring].
Qed.

Theorem one_direction f f1 f2 f3 m x : derives f f1 -> derives f1 f2 -> derives f2 f3 ->
  (forall t, -1 <= t <= 1 -> Rabs (f3 t) <= m) -> -1 <= x <= 1 -> Rabs (f x - through f x) <= m / 24.
Proof.
intros D1 D2 D3 M X.
assert (R2 := r2). assert (R := r_range).
assert (M0 : 0 <= m) by (apply Rle_trans with (Rabs (f3 0)); [apply Rabs_pos | apply M; lra]).
assert (at0 : through f 0 = f 0) by (unfold through; field; lra).
assert (atr : through f r = f r) by (unfold through; field; lra).
assert (atl : through f (- r) = f (- r)) by (unfold through; field; lra).
destruct (Req_dec x 0) as [->|N0]; [rewrite at0, Rminus_diag_eq, Rabs_R0; lra|].
destruct (Req_dec x r) as [->|Nr]; [rewrite atr, Rminus_diag_eq, Rabs_R0; lra|].
destruct (Req_dec x (- r)) as [->|Nl]; [rewrite atl, Rminus_diag_eq, Rabs_R0; lra|].
set (w := x * (x * x - r * r)).
assert (W : w <> 0).
{ unfold w. replace (x * (x * x - r * r)) with (x * ((x - r) * (x + r))) by ring.
  repeat apply Rmult_integral_contrapositive_currified; intro Z; [apply N0 | apply Nr | apply Nl]; lra. }
assert (W4 : Rabs w <= / 4).
{ unfold w. rewrite R2.
  assert (0 <= (1 + x) * ((x - / 2) * (x - / 2)) /\ 0 <= (1 - x) * ((x + / 2) * (x + / 2))).
  { split; (apply Rmult_le_pos; [lra | apply Rle_0_sqr]). }
  apply Rabs_le. split; lra. }
set (k := (f x - through f x) / w).
set (b := (f r - f (- r)) / (2 * r) - k * (r * r)).
set (c := (f r + f (- r) - 2 * f 0) / (2 * r * r)).
set (g t := f t - (f 0 + b * t + c * (t * t) + k * (t * (t * t)))).
set (g1 t := f1 t - (b + 2 * c * t + 3 * k * (t * t))).
set (g2 t := f2 t - (2 * c + 6 * k * t)).
set (g3 t := f3 t - 6 * k).
assert (G : forall t, g t = f t - through f t - k * (t * (t * t - r * r))) by (intro t; unfold g, b, c, through; ring).
assert (E1 : derives g g1) by (apply minus_quadratic, D1).
assert (E2 : derives g1 g2).
{ intros t T. apply (is_derive_minus f1 (fun t => b + 2 * c * t + 3 * k * (t * t))); [apply D2, T|].
  auto_derive; [exact I | ring]. }
assert (E3 : derives g2 g3).
{ intros t T. apply (is_derive_minus f2 (fun t => 2 * c + 6 * k * t)); [apply D3, T|].
  auto_derive; [exact I | ring]. }
assert (G0 : g 0 = 0) by (rewrite G, at0; ring).
assert (Gr : g r = 0) by (rewrite G, atr; ring).
assert (Gl : g (- r) = 0) by (rewrite G, atl; ring).
assert (Gx : g x = 0) by (rewrite G; change (x * (x * x - r * r)) with w; unfold k; field; exact W).
assert (Z : exists t, -1 <= t <= 1 /\ g3 t = 0).
{ destruct (Rlt_dec x (- r)); [apply (rolle3 g g1 g2 g3 x (- r) 0 r); auto; lra|].
  destruct (Rlt_dec x 0); [apply (rolle3 g g1 g2 g3 (- r) x 0 r); auto; lra|].
  destruct (Rlt_dec x r); [apply (rolle3 g g1 g2 g3 (- r) 0 x r); auto; lra|].
  apply (rolle3 g g1 g2 g3 (- r) 0 r x); auto; lra. }
destruct Z as [t [T Z]]. unfold g3 in Z.
replace (f x - through f x) with (k * w) by (unfold k; field; exact W).
rewrite Rabs_mult. specialize (M t T).
assert (K : Rabs k <= m / 6).
{ replace k with (f3 t / 6) by lra. unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 6)); lra. }
generalize (Rabs_pos k) (Rabs_pos w). nra.
Qed.

(* The Lebesgue constant of three Chebyshev nodes. *)
Theorem lebesgue g e x : Rabs (g (- r)) <= e -> Rabs (g 0) <= e -> Rabs (g r) <= e -> -1 <= x <= 1 ->
  Rabs (through g x) <= 5 / 3 * e.
Proof.
intros A B C X. assert (R2 := r2). assert (R := r_range).
replace (through g x) with (g (- r) * (2 / 3 * (x * x - r * x)) + g 0 * (1 - 4 / 3 * (x * x)) + g r * (2 / 3 * (x * x + r * x))).
2:{ unfold through. replace (2 * r * r) with (3 / 2) by lra. replace (/ (2 * r)) with (2 / 3 * r).
    unfold Rdiv at 4. replace (/ (2 * r)) with (2 / 3 * r). field.
    all: apply Rmult_eq_reg_r with (2 * r); [rewrite Rinv_l|]; nra. }
assert (E : 0 <= e) by (generalize (Rabs_pos (g 0)); lra).
set (a := 2 / 3 * (x * x - r * x)). set (b := 1 - 4 / 3 * (x * x)). set (c := 2 / 3 * (x * x + r * x)).
apply Rle_trans with (e * (Rabs a + Rabs b + Rabs c)).
- eapply Rle_trans; [apply Rabs_triang|]. eapply Rle_trans; [apply Rplus_le_compat_r, Rabs_triang|].
  rewrite !Rabs_mult. generalize (Rabs_pos a) (Rabs_pos b) (Rabs_pos c). nra.
- rewrite (Rmult_comm (5 / 3)). apply Rmult_le_compat_l; [exact E|].
  unfold a, b, c. unfold Rabs. repeat destruct Rcase_abs; nra.
Qed.

Lemma through_minus g h x : through (fun t => g t - h t) x = through g x - through h x.
Proof. unfold through. field. generalize r_range. lra. Qed.

Lemma through_swap f x y : through (fun u => through (f u) y) x = through (fun v => through (fun u => f u v) x) y.
Proof. unfold through. field. generalize r_range. lra. Qed.

Section Square.
Variables (f f1 f2 f3 h1 h2 h3 : R -> R -> R) (m n : R).
Hypothesis along_x : forall y, -1 <= y <= 1 ->
  derives (fun x => f x y) (fun x => f1 x y) /\ derives (fun x => f1 x y) (fun x => f2 x y) /\
  derives (fun x => f2 x y) (fun x => f3 x y) /\ forall x, -1 <= x <= 1 -> Rabs (f3 x y) <= m.
Hypothesis along_y : forall x, -1 <= x <= 1 ->
  derives (f x) (h1 x) /\ derives (h1 x) (h2 x) /\ derives (h2 x) (h3 x) /\ forall y, -1 <= y <= 1 -> Rabs (h3 x y) <= n.

Definition biquadratic x y := through (fun u => through (f u) y) x.

Lemma x_first x y : -1 <= x <= 1 -> -1 <= y <= 1 -> Rabs (f x y - biquadratic x y) <= (m + 5 / 3 * n) / 24.
Proof.
intros X Y. destruct (along_x y Y) as [A [B [C M]]].
assert (P := one_direction _ _ _ _ m x A B C M X).
assert (Q : Rabs (through (fun u => f u y - through (f u) y) x) <= 5 / 3 * (n / 24)).
{ assert (E : forall u, -1 <= u <= 1 -> Rabs (f u y - through (f u) y) <= n / 24).
  { intros u U. destruct (along_y u U) as [A' [B' [C' N]]]. exact (one_direction _ _ _ _ n y A' B' C' N Y). }
  assert (R := r_range). apply lebesgue; try exact X; apply E; lra. }
rewrite through_minus in Q. unfold biquadratic.
replace (f x y - through (fun u => through (f u) y) x) with
  ((f x y - through (fun u => f u y) x) + (through (fun u => f u y) x - through (fun u => through (f u) y) x)) by ring.
eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

Lemma y_first x y : -1 <= x <= 1 -> -1 <= y <= 1 -> Rabs (f x y - biquadratic x y) <= (n + 5 / 3 * m) / 24.
Proof.
intros X Y. destruct (along_y x X) as [A [B [C N]]].
assert (P := one_direction _ _ _ _ n y A B C N Y).
assert (Q : Rabs (through (fun v => f x v - through (fun u => f u v) x) y) <= 5 / 3 * (m / 24)).
{ assert (E : forall v, -1 <= v <= 1 -> Rabs (f x v - through (fun u => f u v) x) <= m / 24).
  { intros v V. destruct (along_x v V) as [A' [B' [C' M]]]. exact (one_direction _ _ _ _ m x A' B' C' M X). }
  assert (R := r_range). apply lebesgue; try exact Y; apply E; lra. }
rewrite (through_minus (f x)) in Q. unfold biquadratic. rewrite through_swap.
replace (f x y - through (fun v => through (fun u => f u v) x) y) with
  ((f x y - through (f x) y) + (through (f x) y - through (fun v => through (fun u => f u v) x) y)) by ring.
eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

Theorem square x y : -1 <= x <= 1 -> -1 <= y <= 1 ->
  Rabs (f x y - biquadratic x y) <= (m + n + 2 / 3 * Rmin m n) / 24.
Proof.
intros X Y. assert (P := x_first x y X Y). assert (Q := y_first x y X Y).
unfold Rmin. destruct Rle_dec; lra.
Qed.
End Square.
