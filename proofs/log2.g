# log2(1 + f) for 1 + f in [1, sqrt 2], `specular::power`: the rounding of the series, relative. f < 0 has the same lines with
# other signs. Below f = 1e-4 the squares vanish beside the first coefficient. 870b-32 is 3.4 u. Its approximation is in log2.v.
@rnd = float<ieee_32, ne>;
f = rnd(f_);
z rnd= f / (f + 2);     z2 rnd= z * z;
Z = f / (f + 2);        Z2 = Z * Z;
d0 = rnd(2.88539); d1 = rnd(0.9617967); d2 = rnd(0.57707804); d3 = rnd(0.41219858);
s rnd= z * (((z2 * d3 + d2) * z2 + d1) * z2 + d0);
S = Z * (((Z2 * d3 + d2) * Z2 + d1) * Z2 + d0);
{ f in [0.0001, 0.4143] -> s -/ S in [-870b-32, 870b-32] }
