# |r - o|, `Phong::levels` in shading/phong.rs: t = 2 n.l, then n t - l i - o, where i = 1 / |l|.
# By hand, as norms: a vector whose components are rounded errs by u times its length. Relative to lengths of one:
#   n, o    a unit vector errs by 4.51 u                                                (unit.g)
#   i       errs by 3.51 u                                                              (unit.g)
#   k       n.l of a given n errs by 8.1 u; the error of n adds 4.51 u: below 13 u      (below)
#           for L of another length, too: the product errs by 3 u |L|, the inverse by 3.51 u / |L|, their product by u
#   n t     |n| |error of t| + |t| |error of n| + u |n t|,  t <= 2
#   l i     3.51 u + u;    first difference, of length 1: u;    second, of length at most 2: 2 u
@rnd = float<24,-1000,ne>;
a = rnd(a_); b = rnd(b_); c = rnd(c_); p = rnd(p_); q = rnd(q_); r = rnd(r_);
l rnd= (p * p + q * q) + r * r;   L = (p * p + q * q) + r * r;
i rnd= 1 / sqrt(l);               I = 1 / sqrt(L);
d rnd= (a * p + b * q) + c * r;   D = (a * p + b * q) + c * r;
k rnd= d * i;                     K = D * I;
{ |a| in [1b-60, 1] /\ |b| in [1b-60, 1] /\ |c| in [1b-60, 1]
  /\ |p| in [1b-60, 1] /\ |q| in [1b-60, 1] /\ |r| in [1b-60, 1]
  /\ L in [0.999, 1.001] /\ D in [-1.001, 1.001] /\ K in [-1, 1] /\ |a * p + b * q| <= 1.001
  /\ unit in [0, 1155b-32] /\ inverse in [0, 899b-32] /\ cosine in [0, 2074b-32]
  -> |k - K| <= 2074b-32 /\ cosine + unit <= 13b-24
  /\ 2 * (cosine + unit) + 2 * unit + 2b-24 + (inverse + 1b-24) + 1b-24 + 2b-24 + unit <= 50b-24 }
k - K -> (k - d * i) + ((d - D) * i + D * I * ((i - I) / I)) { I <> 0 };
