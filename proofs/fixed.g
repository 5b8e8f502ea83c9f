# Levels in multiples of 1/256, `interpolation::FIXED_ERROR` = 4b-9: a number between 2^15 and 2^16 is rounded to such a multiple.
# Range: 49152 and half a level, and a value from 0 to 16000. What f32 makes of the terms v, w, t, a, b is counted in rows.v.
@rnd = float<ieee_32, ne>;
m = rnd(M);                  # `QuadraticRows`: the middle, then the terms in x, then those in y, then that of the fourth channel
c rnd= v + m;
k rnd= c + w;
l rnd= k + t;
s rnd= a + 49152;            # `LinearRows`: the start of a row, and what a column adds
d rnd= b + 49152;
{ M in [32768, 65535] /\ v + m in [32768, 65535] /\ c + w in [32768, 65535] /\ k + t in [32768, 65535]
  /\ a + 49152 in [32768, 65535] /\ b + 49152 in [32768, 65535]
  -> |l - (M + v + w + t)| <= 4b-9 /\ |(s + d) - (a + b + 98304)| <= 2b-9 }
l - (M + v + w + t) -> (l - (k + t)) + ((k - (c + w)) + ((c - (v + m)) + (m - M)));
(s + d) - (a + b + 98304) -> (s - (a + 49152)) + (d - (b + 49152));
