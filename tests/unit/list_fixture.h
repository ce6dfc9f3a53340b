// Calls through the table entry points use, and what they make the device draw: directly, and from a list.
#pragma once

#include <functional>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {

using raster::recorded_draws;

// Commands as a program gives them: through the table entry points use.
struct Calls {
  Context& c;
  const OperationTable& table() const { return *current_binding.table; }
  void new_list(GLuint name, GLenum mode = GL_COMPILE) { table().new_list(c, name, mode); }
  void end_list() { table().end_list(c); }
  void call_list(GLuint name) { table().call_list(c, name); }
  void begin(GLenum mode) { table().begin(c, mode); }
  void end() { table().end(c); }
  void vertex(float x, float y = 0, float z = 0, float w = 1) { table().vertex(c, x, y, z, w); }
  void color(float r, float g = 0, float b = 0, float a = 1) { table().color(c, r, g, b, a); }
  void normal(float x, float y = 0, float z = 0) { table().normal(c, x, y, z); }
  void tex_coord(float s, float t = 0, float r = 0, float q = 1) { table().tex_coord(c, s, t, r, q); }
  void edge_flag(bool flag) { table().edge_flag(c, flag); }
  void enable(GLenum cap) { table().enable(c, cap); }
  void material(GLenum name, std::vector<float> v) { table().material(c, GL_FRONT, name, v.data()); }
  GLenum error() { return table().get_error(c); }
  GLint get(GLenum name) {
    GLint value = -1;
    table().get_integerv(c, name, &value);
    return value;
  }
};

class ListTest : public StateTest {
 protected:
  ListTest() { recorded_draws.clear(); }
  Calls calls() { return {*context}; }
  // What `stream` makes the device draw, and the state it leaves behind.
  struct Outcome {
    std::vector<std::pair<GLenum, std::vector<raster::RecordedVertex>>> draws;
    Snapshot state;
    GLenum error;
    bool operator==(const Outcome&) const = default;
  };
  // Separate primitives count as one draw however they were parted.
  Outcome take_outcome() {
    op::flush(*context);
    Outcome outcome{{}, take_snapshot(*context), op::get_error(*context)};
    for (const auto& draw : recorded_draws) {
      const GLenum mode = GLenum(draw.primitive);
      const bool separate = mode == GL_POINTS || mode == GL_LINES || mode == GL_TRIANGLES || mode == GL_QUADS;
      auto& draws = outcome.draws;
      if (!separate || draws.empty() || draws.back().first != mode) draws.push_back({mode, {}});
      draws.back().second.insert(draws.back().second.end(), draw.vertices.begin(), draw.vertices.end());
    }
    recorded_draws.clear();
    return outcome;
  }
  void renew() {
    context = std::make_unique<Context>(VisualConfig{}, nullptr);
    make_current(context.get(), &drawable);
    recorded_draws.clear();
  }
  // `before` sets the state up, `stream` is called directly, from a list, and compiled and executed.
  void expect_same(const std::function<void(Calls)>& stream, const std::function<void(Calls)>& before = {}) {
    const auto start = [&] {
      renew();
      if (before) before(calls());
    };
    start();
    stream(calls());
    const Outcome direct = take_outcome();
    start();
    calls().new_list(1);
    stream(calls());
    calls().end_list();
    EXPECT_TRUE(recorded_draws.empty());
    calls().call_list(1);
    EXPECT_EQ(take_outcome(), direct) << "compiled";
    start();
    calls().new_list(1, GL_COMPILE_AND_EXECUTE);
    stream(calls());
    calls().end_list();
    EXPECT_EQ(take_outcome(), direct) << "compiled and executed";
  }
};

}  // namespace halfspace::state
