// Per-fragment operations, clears and the accumulation buffer.
#include "maker.h"

namespace halfspace::fuzz {
namespace {

double compare_function(Maker& m) { return GL_NEVER + m.random.below(8); }

void add_blend(Maker& m) {
  m.set_enabled(GL_BLEND, m.random.chance(80));
  const double source =
      m.random.pick({GL_ZERO, GL_ONE, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA,
                     GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_SRC_ALPHA_SATURATE});
  const double destination =
      m.random.pick({GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA,
                     GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA});
  m.call(Command::glBlendFunc, {source, destination});
}

void add_depth(Maker& m) {
  m.set_enabled(GL_DEPTH_TEST, m.random.chance(80));
  m.call(Command::glDepthFunc, {compare_function(m)});
  if (m.random.chance(30)) m.call(Command::glDepthMask, {double(m.random.below(2))});
}

// Between two levels, so that no rounding decides.
void add_alpha(Maker& m) {
  m.set_enabled(GL_ALPHA_TEST, m.random.chance(80));
  m.call(Command::glAlphaFunc,
         {compare_function(m), double(static_cast<float>((m.random.below(255) + 0.5) / 255))});
}

void add_stencil(Maker& m) {
  m.set_enabled(GL_STENCIL_TEST, m.random.chance(85));
  const double mask = m.random.chance(60) ? 255 : m.random.below(256);
  m.call(Command::glStencilFunc, {compare_function(m), double(m.random.below(4)), mask});
  const auto operation = [&] {
    return double(m.random.pick({GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT}));
  };
  const double fail = operation(), depth_fail = operation(), pass = operation();
  m.call(Command::glStencilOp, {fail, depth_fail, pass});
  if (m.random.chance(30)) m.call(Command::glStencilMask, {double(m.random.below(256))});
}

void add_logic_op(Maker& m) {
  if (!m.exact) return;
  m.set_enabled(GL_COLOR_LOGIC_OP, m.random.chance(80));
  m.call(Command::glLogicOp, {double(GL_CLEAR + m.random.below(16))});
}

void add_scissor(Maker& m) {
  m.set_enabled(GL_SCISSOR_TEST, m.random.chance(70));
  m.call(Command::glScissor, {double(m.random.between(-10, 60)), double(m.random.between(-10, 50)),
                              double(m.random.between(0, 100)), double(m.random.between(0, 80))});
}

void add_color_mask(Maker& m) {
  const auto on = [&] { return double(m.random.chance(75)); };
  const double r = on(), g = on(), b = on(), a = on();
  m.call(Command::glColorMask, {r, g, b, a});
}

void add_fog(Maker& m) {
  m.set_enabled(GL_FOG, m.random.chance(85));
  m.call(Command::glFogi, {GL_FOG_MODE, double(m.random.pick({GL_LINEAR, GL_EXP, GL_EXP2}))});
  m.call(Command::glFogf, {GL_FOG_DENSITY, m.random.real(0, 1.5)});
  m.call(Command::glFogf, {GL_FOG_START, m.random.real(-1, 1)});
  m.call(Command::glFogf, {GL_FOG_END, m.random.real(1.5, 4)});
  m.call(Command::glFogfv, {GL_FOG_COLOR, 0}, m.color());
  // GL lets fog be computed at the corners; asked for the best, nobody does.
  m.call(Command::glHint, {GL_FOG_HINT, GL_NICEST});
}

void add_clear(Maker& m) {
  const std::vector<float> color = m.color();
  m.call(Command::glClearColor, {double(color[0]), double(color[1]), double(color[2]), double(color[3])});
  m.call(Command::glClearDepth, {m.random.real(0, 1)});
  m.call(Command::glClearStencil, {double(m.random.below(256))});
  const double mask = m.random.pick({GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT, GL_STENCIL_BUFFER_BIT,
                                     GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT,
                                     GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT});
  m.call(Command::glClear, {mask});
}

// Small steps: what leaves [-1, 1] is undefined (4.2.4).
void add_accumulation(Maker& m) {
  switch (m.random.below(6)) {
    case 0: {
      const std::vector<float> color = m.color();
      m.call(Command::glClearAccum,
             {double(color[0]) / 2, double(color[1]) / 2, double(color[2]) / 2, double(color[3]) / 2});
      m.call(Command::glClear, {GL_ACCUM_BUFFER_BIT});
      break;
    }
    case 1:
      m.call(Command::glAccum, {GL_LOAD, m.random.real(0, 0.5)});
      break;
    case 2:
      m.call(Command::glAccum, {GL_ACCUM, m.random.real(-0.0625, 0.0625)});
      break;
    case 3:
      m.call(Command::glAccum, {GL_MULT, m.random.real(0, 1)});
      break;
    case 4:
      m.call(Command::glAccum, {GL_ADD, m.random.real(-0.0625, 0.0625)});
      break;
    default:
      break;
  }
  if (m.random.chance(40)) m.call(Command::glAccum, {GL_RETURN, m.random.real(0.5, 1.5)});
}

}  // namespace

const std::vector<Feature>& fragment_features() {
  static const std::vector<Feature> kFeatures = {
      {.group = "blend", .add = add_blend, .weight = 2, .exact = false},
      {"depth", add_depth, 2},
      {"alpha", add_alpha},
      {"stencil", add_stencil, 3},
      {"logic_op", add_logic_op, 2},
      {"scissor", add_scissor},
      {"color_mask", add_color_mask},
      {.group = "fog", .add = add_fog, .weight = 2, .exact = false},
      {"clear", add_clear},
      {.group = "accumulation", .add = add_accumulation, .weight = 2, .exact = false},
  };
  return kFeatures;
}

}  // namespace halfspace::fuzz
