(* log2(1 + f) with z = f / (2 + f), `specular::power`: the series with its coefficients as f32 has them, relative. *)
From Coq Require Import Reals.
From Interval Require Import Tactic.
Open Scope R_scope.
Goal forall z, 1/1024 <= z <= 1716/10000 ->
  Rabs (z * ((12102203/4194304) + (16136271/16777216)*z^2 + (9681763/16777216)*z^4 + (13831089/33554432)*z^6) * ln 2
        - ln ((1+z)/(1-z))) <= 98/1000000000 * ln ((1+z)/(1-z)).
Proof. intros z H. apply Rminus_le. interval with (i_bisect z, i_taylor z, i_degree 10, i_prec 90, i_depth 20). Qed.
