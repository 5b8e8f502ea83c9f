(* The third derivative of a quotient of affine functions, `bound::quotient_error`: (a + b t) / (w + e t). *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Section Quotient.
Variables a b w e : R.
Definition d t := w + e * t.
Definition k := b * w - a * e.
Definition f t := (a + b * t) / d t.
Definition f1 t := k / (d t * d t).
Definition f2 t := -2 * e * k / (d t * d t * d t).
Definition f3 t := 6 * (e * e) * k / (d t * d t * (d t * d t)).

Theorem derivatives t : d t <> 0 -> is_derive f t (f1 t) /\ is_derive f1 t (f2 t) /\ is_derive f2 t (f3 t).
Proof.
intros D. unfold f, f1, f2, f3, k, d in *.
refine (conj _ (conj _ _)); auto_derive; try (repeat apply Rmult_integral_contrapositive_currified; exact D);
  try (field; exact D); exact D.
Qed.

Theorem bound t least : 0 < least -> least <= Rabs (d t) ->
  Rabs (f3 t) <= Rabs k * (e * e) * (6 / (least * least * (least * least))).
Proof.
intros L D. unfold f3, Rdiv. rewrite 2!Rabs_mult, Rabs_inv, (Rabs_pos_eq (6 * (e * e))), !Rabs_mult.
2: generalize (Rle_0_sqr e); unfold Rsqr; lra.
replace (Rabs k * (e * e) * (6 * / (least * least * (least * least)))) with
  (6 * (e * e) * Rabs k * / (least * least * (least * least))) by ring.
apply Rmult_le_compat_l.
- apply Rmult_le_pos; [generalize (Rle_0_sqr e); unfold Rsqr; lra | apply Rabs_pos].
- assert (S : 0 < least * least) by (apply Rmult_lt_0_compat; exact L).
  assert (T : least * least <= Rabs (d t) * Rabs (d t)) by (apply Rmult_le_compat; lra).
  apply Rinv_le_contravar; [apply Rmult_lt_0_compat; exact S | apply Rmult_le_compat; lra].
Qed.
End Quotient.
