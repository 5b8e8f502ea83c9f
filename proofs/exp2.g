# 2^g for |g| <= 1/2, `specular::power`: the rounding of the polynomial. 390b-32 is 1.52 u. Its approximation is in exp2.v.
@rnd = float<ieee_32, ne>;
g = rnd(g_);
c6 = rnd(0.0001540353); c5 = rnd(0.0013333558); c4 = rnd(0.009618129); c3 = rnd(0.05550411); c2 = rnd(0.2402265);
c1 = rnd(0.6931471805599453);
m rnd= (((((c6 * g + c5) * g + c4) * g + c3) * g + c2) * g + c1) * g + 1;
M = (((((c6 * g + c5) * g + c4) * g + c3) * g + c2) * g + c1) * g + 1;
{ g in [-0.5, 0.5] -> m -/ M in [-390b-32, 390b-32] }
