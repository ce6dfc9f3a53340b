// Sine and cosine in degrees, the same bits on every machine: libm's choose their code by the CPU.
#pragma once

namespace halfspace::state {

struct SineCosine {
  double sine, cosine;
};

// Error below 1 ulp each; exact at multiples of 90 degrees. NaN when `degrees` is not finite.
SineCosine sine_cosine_degrees(double degrees);

}  // namespace halfspace::state
