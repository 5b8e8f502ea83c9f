# n.l without a highlight, `Phong::levels` in shading/phong.rs: N.L / sqrt(N.N L.L), of vectors that are given.
# Relative to lengths of one, as in chord.g; 2573b-32 is 10.05 u.
@rnd = float<24,-1000,ne>;
a = rnd(a_); b = rnd(b_); c = rnd(c_); p = rnd(p_); q = rnd(q_); r = rnd(r_);
n rnd= (a * a + b * b) + c * c;   N = (a * a + b * b) + c * c;
l rnd= (p * p + q * q) + r * r;   L = (p * p + q * q) + r * r;
m rnd= n * l;                     M = N * L;
i rnd= 1 / sqrt(m);               I = 1 / sqrt(M);
d rnd= (a * p + b * q) + c * r;   D = (a * p + b * q) + c * r;
k rnd= d * i;                     K = D * I;
{ |a| in [1b-60, 1] /\ |b| in [1b-60, 1] /\ |c| in [1b-60, 1]
  /\ |p| in [1b-60, 1] /\ |q| in [1b-60, 1] /\ |r| in [1b-60, 1]
  /\ N in [0.999, 1.001] /\ L in [0.999, 1.001] /\ D in [-1.001, 1.001] /\ K in [-1, 1] /\ |a * p + b * q| <= 1.001
  -> |k - K| <= 2573b-32 }
k - K -> (k - d * i) + ((d - D) * i + D * I * ((i - I) / I)) { I <> 0 };
