# The quadratic in x = 1 - s of `Squarings`: coefficients rounded to f32, then evaluated; an absolute error.
# Range: exponents 1 to 2, so that a is about 1, b from -2 to -1 and c from 0 to 1. Each squaring adds u at most, relative.
@rnd = float<ieee_32, ne>;
x = rnd(x_); a = rnd(A); b = rnd(B); c = rnd(C);
p rnd= (x * c + b) * x + a;   P = (x * C + B) * x + A;
{ x in [0, 1] /\ A in [0.5, 1.001] /\ B in [-2, -0.9] /\ C in [0, 1] /\ P in [0, 1.001] -> |p - P| <= 6b-24 }
