// Sine and cosine of parts of a turn, inline and without branches, for loops that compilers vectorise.
// PUBLIC.
#pragma once

#include <numbers>

namespace slvm {

/// Of 2 PI turn, with an absolute error below 1e-7; exact at whole quarters. |turn| < 2^29. Taylor's
/// polynomials of an eighth of a turn.
inline void sine_and_cosine(float turn, float& sine, float& cosine) {
  const float quarters = (turn - static_cast<float>(static_cast<int>(turn))) * 4;
  const int quarter = static_cast<int>(quarters + 4.5f) - 4; // to the nearest, of -4 to 4
  const float x = (quarters - static_cast<float>(quarter)) * (std::numbers::pi_v<float> / 2), x2 = x * x;
  const float s = x * (1 + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 / 362880))));
  const float c = 1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 / 40320)));
  const float a = quarter & 1 ? c : s, b = quarter & 1 ? s : c;
  sine = quarter & 2 ? -a : a;
  cosine = (quarter + 1) & 2 ? -b : b;
}

} // namespace slvm
