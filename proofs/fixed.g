# Levels in multiples of 1/256, `interpolation::FIXED_ERROR` = 3b-9: a number between 2^15 and 2^16 is rounded to such a multiple.
# Range: 49152 and half a level, and a value from 0 to 256. What f32 makes of the terms v, w, a, b is counted in rows.v.
@rnd = float<ieee_32, ne>;
m = rnd(M);                  # `Curve`: the middle, then the terms in x, then those in y
c rnd= v + m;
l rnd= c + w;
s rnd= a + 49152;            # `Ramp`: the start of a row, and what a column adds
d rnd= b + 49152;
{ M in [32768, 65535] /\ v + m in [32768, 65535] /\ c + w in [32768, 65535]
  /\ a + 49152 in [32768, 65535] /\ b + 49152 in [32768, 65535]
  -> |l - (M + v + w)| <= 3b-9 /\ |(s + d) - (a + b + 98304)| <= 2b-9 }
l - (M + v + w) -> (l - (c + w)) + ((c - (v + m)) + (m - M));
(s + d) - (a + b + 98304) -> (s - (a + 49152)) + (d - (b + 49152));
