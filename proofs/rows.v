(* A value in a row in f32, `interpolation::ROW_ERROR`, relative to the sum of the sizes of its terms.

   By hand: each rounding multiplies all terms that were summed so far by 1 + e, |e| <= u = 2^-24. The term in x^2 y^2 is
   rounded most often: its coefficient, two products and two sums with powers of x, as many with powers of y (9), then, of the
   light that crosses zero, its coefficient, a product and a sum (3). The display step may be that of the next float (2). *)
From Coq Require Import Reals.
From Interval Require Import Tactic.
Open Scope R_scope.
Goal forall e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 : R, let u := 1 / 16777216 in
  -u <= e1 <= u -> -u <= e2 <= u -> -u <= e3 <= u -> -u <= e4 <= u -> -u <= e5 <= u -> -u <= e6 <= u -> -u <= e7 <= u ->
  -u <= e8 <= u -> -u <= e9 <= u -> -u <= e10 <= u -> -u <= e11 <= u -> -u <= e12 <= u -> 0 <= e13 <= 2 * u ->
  Rabs ((1+e1)*(1+e2)*(1+e3)*(1+e4)*(1+e5)*(1+e6)*(1+e7)*(1+e8)*(1+e9)*(1+e10)*(1+e11)*(1+e12)*(1+e13) - 1) <= 14001/1000 * u.
Proof. intros. unfold u in *. interval with (i_prec 90). Qed.
