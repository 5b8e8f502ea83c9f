(* A value in a row in f32, `interpolation::ROW_ERROR`, relative to the sum of the sizes of its terms.

   By hand: each rounding multiplies all terms that were summed so far by 1 + e, |e| <= u = 2^-24. The term in x^2 y^2 is
   rounded most often: its coefficient, two products and two sums with powers of x, as many with powers of y (9), then, of the
   fourth channel, the coefficient of its term, a product and a sum (3). The display step may be that of the next float (2).
   The exponent y of a highlight has the nine. They err by d, at most 1, so 2^y errs by at most 2^y d, for 2^d is convex and 1 + d
   at 0 and 1; and 2^y, below 1.3, is that of the samples, whose own error is at most a quarter in units of 1/ln 2. The
   power of two errs by 4.3 u (power.v). 9 times 1.3 of the size of y, and 9.3 times 1.3 of 2^y, are below 14. *)
From Coq Require Import Reals.
From Interval Require Import Tactic.
Open Scope R_scope.
Goal forall e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 : R, let u := 1 / 16777216 in
  -u <= e1 <= u -> -u <= e2 <= u -> -u <= e3 <= u -> -u <= e4 <= u -> -u <= e5 <= u -> -u <= e6 <= u -> -u <= e7 <= u ->
  -u <= e8 <= u -> -u <= e9 <= u -> -u <= e10 <= u -> -u <= e11 <= u -> -u <= e12 <= u -> 0 <= e13 <= 2 * u ->
  Rabs ((1+e1)*(1+e2)*(1+e3)*(1+e4)*(1+e5)*(1+e6)*(1+e7)*(1+e8)*(1+e9)*(1+e10)*(1+e11)*(1+e12)*(1+e13) - 1) <= 14001/1000 * u.
Proof. intros. unfold u in *. interval with (i_prec 90). Qed.
