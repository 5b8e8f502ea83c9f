# |V x V_x| in f64, `moving::CROSS_ERROR`: the root of |r|^2 - (m.r)^2, where m = V / |V| and r is V_x times half the square.
# Range: |r| = 1; all lines are homogeneous in r. By hand: a component of m errs by 4.51 u and one of r by u, u = 2^-53, each
# relative (unit.g), so m.r by 5.51 u before its own roundings (Cauchy and Schwarz), and |r| by 5 u. As |sqrt a - sqrt b| is at
# most sqrt |a - b|, the cross product errs by sqrt(34 u) < 6.2e-8 of |r|; CROSS_ERROR is 1e-7.
@rnd = float<53,-2000,ne>;
a rnd= (m * p + n * q) + o * r;   B = (m * p + n * q) + o * r;
d rnd= l * l - a * a;
{ |m * p| <= 1.001 /\ |n * q| <= 1.001 /\ |o * r| <= 1.001 /\ |m * p + n * q| <= 1.001 /\ |B| <= 1.001
  /\ |A| <= 1 /\ |B - A| <= 353b-59 /\ |l - 1| <= 5b-53
  -> |d - (1 - A * A)| <= 34b-53 }
