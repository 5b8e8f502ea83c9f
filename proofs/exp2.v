(* 2^g for |g| <= 1/2, `specular::power`: the polynomial with its coefficients as f32 has them, against 2^g. *)
From Coq Require Import Reals.
From Interval Require Import Tactic.
Open Scope R_scope.
Goal forall g, -1/2 <= g <= 1/2 ->
  Rabs ((1 + (1453635/2097152)*g^1 + (1007583/4194304)*g^2 + (14899271/268435456)*g^3
         + (10327387/1073741824)*g^4 + (11453439/8589934592)*g^5 + (10585225/68719476736)*g^6)
        / exp (g * ln 2) - 1) <= 161/1000000000.
Proof. intros g H. interval with (i_bisect g, i_taylor g, i_degree 10, i_prec 90). Qed.
