# n.l, `kernel::cosine`: N.L / sqrt(N.N L.L).
# Range: lengths within 0.1 % of one. All lines are homogeneous in N and in L, so the bound holds for any length.
# By hand: |N.L| <= |N| |L| and |a p + b q| <= |N| |L| (Cauchy and Schwarz).
@rnd = float<24,-1000,ne>;
a = rnd(a_); b = rnd(b_); c = rnd(c_); p = rnd(p_); q = rnd(q_); r = rnd(r_);
d rnd= (a * p + b * q) + c * r;   D = (a * p + b * q) + c * r;
n rnd= (a * a + b * b) + c * c;   N = (a * a + b * b) + c * c;
l rnd= (p * p + q * q) + r * r;   L = (p * p + q * q) + r * r;
s rnd= sqrt(n * l);               S = sqrt(N * L);
k rnd= d / s;                     K = D / S;
{ |a| in [1b-60, 1] /\ |b| in [1b-60, 1] /\ |c| in [1b-60, 1]
  /\ |p| in [1b-60, 1] /\ |q| in [1b-60, 1] /\ |r| in [1b-60, 1]
  /\ N in [0.999, 1.001] /\ L in [0.999, 1.001] /\ S in [0.998, 1.002]
  /\ D in [-1.001, 1.001] /\ K in [-1, 1] /\ |a * p + b * q| <= 1.001
  -> |k - K| <= 10b-24 }
d / s - K -> (d - D) / s - K * ((s - S) / S) / (1 + (s - S) / S) { s <> 0, S <> 0 };
k - K -> (k - d / s) + (d / s - K);
