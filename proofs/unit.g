# A vector brought to length one, `Phong::levels`: component = x / sqrt(x x + y y + z z), by an inverse and a product.
# Range: components of any size, lengths from 1/2 to 2. A square that underflows is lost beside such a length, so the
# exponent has no lower bound here. 899b-32 is 3.51 u, 1155b-32 is 4.51 u.
@rnd = float<24,-1000,ne>;
x = rnd(x_); y = rnd(y_); z = rnd(z_);
l rnd= (x * x + y * y) + z * z;   L = (x * x + y * y) + z * z;
i rnd= 1 / sqrt(l);               I = 1 / sqrt(L);
c rnd= x * i;                     C = x * I;
{ |x| in [1b-60, 2] /\ |y| in [1b-60, 2] /\ |z| in [1b-60, 2] /\ L in [0.25, 4]
  -> i -/ I in [-899b-32, 899b-32] /\ c -/ C in [-1155b-32, 1155b-32] }
