# n.l from two unit vectors in f64, `bound::ROUNDING`: where it may be zero.
# By hand: a component of each vector errs by 4.51 u, u = 2^-53 (unit.g), so n.l by 9.02 u before its own roundings (Cauchy and
# Schwarz). 15 u is 1.67e-15.
@rnd = float<53,-2000,ne>;
d rnd= (a * p + b * q) + c * r;   D = (a * p + b * q) + c * r;
{ |a * p| <= 1.001 /\ |b * q| <= 1.001 /\ |c * r| <= 1.001 /\ |a * p + b * q| <= 1.001 /\ |D| <= 1.001
  /\ |D - K| <= 578b-59
  -> |d - K| <= 15b-53 }
