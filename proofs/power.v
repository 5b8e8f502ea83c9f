(* s^rho = 2^(rho log2 s), `specular::power`, in units u = 2^-24, for any rho.

   By hand: log2 s errs by 3.4 u and 9.8e-8 = 1.65 u of the series, relative (log2.g, log2.v). Where an exponent is added, the
   series is at most as large as the sum, so the sum errs by u more, and 1 - (1 - s) by at most 2.1 u of it. Rounding rho and
   the product adds 2 u: together 10.2 u, `EXPONENT_ERROR`. So the exponent z = |ln s^rho| errs by 10.2 u z. The power of two errs by 1.52 u and
   1.61e-7 = 2.71 u (exp2.g, exp2.v): together 4.3 u, relative. *)
From Coq Require Import Reals.
From Interval Require Import Tactic.
Open Scope R_scope.
Goal forall z, 0 <= z <= 100 -> (102/10 * z + 43/10) * exp (- z) <= 6/1.
Proof. intros z H. interval with (i_bisect z, i_taylor z, i_depth 30). Qed.
