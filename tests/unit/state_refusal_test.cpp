// A refused call records the spec's error and changes nothing; between Begin and End everything but vertex
// data is refused.
#include <array>
#include <functional>
#include <limits>

#include "state_fixture.h"

namespace halfspace::state {
namespace {

const float kNoFloats[4] = {-1, 0, 0, 0};
const float kOnes[4] = {1, 1, 1, 1};
const double kIdentityDouble[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
const double kNan = std::numeric_limits<double>::quiet_NaN();

struct Refusal {
  const char* name;
  GLenum error;
  std::function<void(Context&)> call;
};

const std::vector<Refusal> kRefusals = {
    {"begin", GL_INVALID_ENUM, [](Context& c) { op::begin(c, GL_POLYGON + 1); }},
    {"end", GL_INVALID_OPERATION, [](Context& c) { op::end(c); }},
    {"material face", GL_INVALID_ENUM, [](Context& c) { op::material(c, GL_LEFT, GL_AMBIENT, kNoFloats); }},
    {"material name", GL_INVALID_ENUM, [](Context& c) { op::material(c, GL_FRONT, GL_POSITION, kNoFloats); }},
    {"material shininess", GL_INVALID_VALUE,
     [](Context& c) { op::material(c, GL_FRONT, GL_SHININESS, kNoFloats); }},
    {"light name", GL_INVALID_ENUM, [](Context& c) { op::light(c, GL_LIGHT7 + 1, GL_AMBIENT, kOnes); }},
    {"light pname", GL_INVALID_ENUM, [](Context& c) { op::light(c, GL_LIGHT0, GL_EMISSION, kOnes); }},
    {"spot exponent < 0", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_SPOT_EXPONENT, kNoFloats); }},
    {"spot exponent > 128", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_SPOT_EXPONENT, std::array{128.5f}.data()); }},
    {"spot cutoff < 0", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_SPOT_CUTOFF, kNoFloats); }},
    {"spot cutoff 91", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_SPOT_CUTOFF, std::array{91.0f}.data()); }},
    {"spot cutoff 181", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_SPOT_CUTOFF, std::array{181.0f}.data()); }},
    {"constant attenuation", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_CONSTANT_ATTENUATION, kNoFloats); }},
    {"linear attenuation", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_LINEAR_ATTENUATION, kNoFloats); }},
    {"quadratic attenuation", GL_INVALID_VALUE,
     [](Context& c) { op::light(c, GL_LIGHT1, GL_QUADRATIC_ATTENUATION, kNoFloats); }},
    {"light_model", GL_INVALID_ENUM, [](Context& c) { op::light_model(c, GL_AMBIENT, kOnes); }},
    {"color_material face", GL_INVALID_ENUM, [](Context& c) { op::color_material(c, GL_LEFT, GL_AMBIENT); }},
    {"color_material mode", GL_INVALID_ENUM,
     [](Context& c) { op::color_material(c, GL_FRONT, GL_SHININESS); }},
    {"get_lightfv name", GL_INVALID_ENUM,
     [](Context& c) { op::get_lightfv(c, GL_LIGHT0 - 1, GL_AMBIENT, nullptr); }},
    {"get_lightiv pname", GL_INVALID_ENUM,
     [](Context& c) { op::get_lightiv(c, GL_LIGHT0, GL_SHININESS, nullptr); }},
    {"get_materialfv face", GL_INVALID_ENUM,
     [](Context& c) { op::get_materialfv(c, GL_FRONT_AND_BACK, GL_AMBIENT, nullptr); }},
    {"get_materialiv pname", GL_INVALID_ENUM,
     [](Context& c) { op::get_materialiv(c, GL_FRONT, GL_AMBIENT_AND_DIFFUSE, nullptr); }},
    {"tex_gen coordinate", GL_INVALID_ENUM,
     [](Context& c) { op::tex_gen(c, GL_S - 1, GL_EYE_PLANE, kIdentityDouble); }},
    {"tex_gen pname", GL_INVALID_ENUM,
     [](Context& c) { op::tex_gen(c, GL_S, GL_TEXTURE_ENV_MODE, kIdentityDouble); }},
    {"tex_gen mode", GL_INVALID_ENUM,
     [](Context& c) { op::tex_gen(c, GL_T, GL_TEXTURE_GEN_MODE, std::array{double(GL_LINEAR)}.data()); }},
    {"tex_gen sphere map of r", GL_INVALID_ENUM,
     [](Context& c) { op::tex_gen(c, GL_R, GL_TEXTURE_GEN_MODE, std::array{double(GL_SPHERE_MAP)}.data()); }},
    {"tex_gen mode NaN", GL_INVALID_ENUM,
     [](Context& c) { op::tex_gen(c, GL_S, GL_TEXTURE_GEN_MODE, &kNan); }},
    {"get_tex_genfv", GL_INVALID_ENUM,
     [](Context& c) { op::get_tex_genfv(c, GL_Q + 1, GL_EYE_PLANE, nullptr); }},
    {"get_tex_geniv", GL_INVALID_ENUM,
     [](Context& c) { op::get_tex_geniv(c, GL_S, GL_TEXTURE_GEN_S, nullptr); }},
    {"get_tex_gendv", GL_INVALID_ENUM, [](Context& c) { op::get_tex_gendv(c, GL_S, GL_S, nullptr); }},
    {"fog", GL_INVALID_ENUM, [](Context& c) { op::fog(c, GL_FOG, kOnes); }},
    {"fog mode", GL_INVALID_ENUM, [](Context& c) { op::fog(c, GL_FOG_MODE, kOnes); }},
    {"fog density", GL_INVALID_VALUE, [](Context& c) { op::fog(c, GL_FOG_DENSITY, kNoFloats); }},
    {"stencil_func", GL_INVALID_ENUM, [](Context& c) { op::stencil_func(c, GL_ALWAYS + 1, 3, 3); }},
    {"stencil_op fail", GL_INVALID_ENUM, [](Context& c) { op::stencil_op(c, GL_SET, GL_ZERO, GL_ZERO); }},
    {"stencil_op depth fail", GL_INVALID_ENUM,
     [](Context& c) { op::stencil_op(c, GL_ZERO, GL_AND, GL_ZERO); }},
    {"stencil_op pass", GL_INVALID_ENUM, [](Context& c) { op::stencil_op(c, GL_ZERO, GL_ZERO, GL_OR); }},
    {"logic_op", GL_INVALID_ENUM, [](Context& c) { op::logic_op(c, GL_SET + 1); }},
    {"accum", GL_INVALID_ENUM, [](Context& c) { op::accum(c, GL_RETURN + 3, 1); }},
    {"accum without a buffer", GL_INVALID_OPERATION, [](Context& c) { op::accum(c, GL_LOAD, 1); }},
    {"vertex_pointer size 1", GL_INVALID_VALUE,
     [](Context& c) { op::vertex_pointer(c, 1, GL_FLOAT, 0, &c); }},
    {"vertex_pointer size 5", GL_INVALID_VALUE,
     [](Context& c) { op::vertex_pointer(c, 5, GL_FLOAT, 0, &c); }},
    {"vertex_pointer stride", GL_INVALID_VALUE,
     [](Context& c) { op::vertex_pointer(c, 4, GL_FLOAT, -1, &c); }},
    {"vertex_pointer type", GL_INVALID_ENUM, [](Context& c) { op::vertex_pointer(c, 4, GL_BYTE, 0, &c); }},
    {"color_pointer size", GL_INVALID_VALUE, [](Context& c) { op::color_pointer(c, 2, GL_FLOAT, 0, &c); }},
    {"color_pointer stride", GL_INVALID_VALUE, [](Context& c) { op::color_pointer(c, 4, GL_FLOAT, -4, &c); }},
    {"color_pointer type", GL_INVALID_ENUM, [](Context& c) { op::color_pointer(c, 4, GL_BITMAP, 0, &c); }},
    {"normal_pointer stride", GL_INVALID_VALUE, [](Context& c) { op::normal_pointer(c, GL_FLOAT, -1, &c); }},
    {"normal_pointer type", GL_INVALID_ENUM,
     [](Context& c) { op::normal_pointer(c, GL_UNSIGNED_BYTE, 0, &c); }},
    {"tex_coord_pointer size", GL_INVALID_VALUE,
     [](Context& c) { op::tex_coord_pointer(c, 0, GL_FLOAT, 0, &c); }},
    {"tex_coord_pointer stride", GL_INVALID_VALUE,
     [](Context& c) { op::tex_coord_pointer(c, 2, GL_FLOAT, -1, &c); }},
    {"tex_coord_pointer type", GL_INVALID_ENUM,
     [](Context& c) { op::tex_coord_pointer(c, 2, GL_BYTE, 0, &c); }},
    {"edge_flag_pointer stride", GL_INVALID_VALUE, [](Context& c) { op::edge_flag_pointer(c, -1, &c); }},
    {"index_pointer stride", GL_INVALID_VALUE, [](Context& c) { op::index_pointer(c, GL_FLOAT, -1, &c); }},
    {"index_pointer type", GL_INVALID_ENUM, [](Context& c) { op::index_pointer(c, GL_BYTE, 0, &c); }},
    {"interleaved_arrays stride", GL_INVALID_VALUE,
     [](Context& c) { op::interleaved_arrays(c, GL_V3F, -1, &c); }},
    {"interleaved_arrays format", GL_INVALID_ENUM,
     [](Context& c) { op::interleaved_arrays(c, GL_V2F - 1, 0, &c); }},
    {"enable_client_state", GL_INVALID_ENUM, [](Context& c) { op::enable_client_state(c, GL_BLEND); }},
    {"disable_client_state", GL_INVALID_ENUM, [](Context& c) { op::disable_client_state(c, GL_BLEND); }},
    {"get_pointerv", GL_INVALID_ENUM, [](Context& c) { op::get_pointerv(c, GL_VERTEX_ARRAY, nullptr); }},
    {"array_element", GL_INVALID_VALUE, [](Context& c) { op::array_element(c, -1); }},
    {"draw_arrays mode", GL_INVALID_ENUM, [](Context& c) { op::draw_arrays(c, 10, 0, 3); }},
    {"draw_arrays first", GL_INVALID_VALUE, [](Context& c) { op::draw_arrays(c, GL_POINTS, -1, 3); }},
    {"draw_arrays count", GL_INVALID_VALUE, [](Context& c) { op::draw_arrays(c, GL_POINTS, 0, -1); }},
    {"draw_elements mode", GL_INVALID_ENUM,
     [](Context& c) { op::draw_elements(c, 10, 3, GL_UNSIGNED_INT, &c); }},
    {"draw_elements count", GL_INVALID_VALUE,
     [](Context& c) { op::draw_elements(c, GL_POINTS, -1, GL_UNSIGNED_INT, &c); }},
    {"draw_elements type", GL_INVALID_ENUM,
     [](Context& c) { op::draw_elements(c, GL_POINTS, 3, GL_INT, &c); }},
    {"matrix_mode", GL_INVALID_ENUM, [](Context& c) { op::matrix_mode(c, GL_COLOR); }},
    {"pop_matrix", GL_STACK_UNDERFLOW, [](Context& c) { op::pop_matrix(c); }},
    {"frustum near 0", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, -1, 1, -1, 1, 0, 1); }},
    {"frustum near < 0", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, -1, 1, -1, 1, -1, 1); }},
    {"frustum far < 0", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, -1, 1, -1, 1, 1, -1); }},
    {"frustum left = right", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, 1, 1, -1, 1, 1, 2); }},
    {"frustum bottom = top", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, -1, 1, 2, 2, 1, 2); }},
    {"frustum near = far", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, -1, 1, -1, 1, 2, 2); }},
    {"frustum NaN", GL_INVALID_VALUE, [](Context& c) { op::frustum(c, -1, 1, kNan, 1, 1, 2); }},
    {"ortho left = right", GL_INVALID_VALUE, [](Context& c) { op::ortho(c, 1, 1, -1, 1, -1, 1); }},
    {"ortho bottom = top", GL_INVALID_VALUE, [](Context& c) { op::ortho(c, -1, 1, 0, 0, -1, 1); }},
    {"ortho near = far", GL_INVALID_VALUE, [](Context& c) { op::ortho(c, -1, 1, -1, 1, 3, 3); }},
    {"viewport width", GL_INVALID_VALUE, [](Context& c) { op::viewport(c, 1, 2, -1, 4); }},
    {"viewport height", GL_INVALID_VALUE, [](Context& c) { op::viewport(c, 1, 2, 3, -4); }},
    {"alpha_func", GL_INVALID_ENUM, [](Context& c) { op::alpha_func(c, GL_ALWAYS + 1, 0.5f); }},
    {"blend_func source", GL_INVALID_ENUM, [](Context& c) { op::blend_func(c, GL_BLEND, GL_ZERO); }},
    {"blend_func destination", GL_INVALID_ENUM,
     [](Context& c) { op::blend_func(c, GL_ZERO, GL_SRC_ALPHA_SATURATE); }},
    {"depth_func above", GL_INVALID_ENUM, [](Context& c) { op::depth_func(c, GL_ALWAYS + 1); }},
    {"alpha_func below", GL_INVALID_ENUM, [](Context& c) { op::alpha_func(c, GL_NEVER - 1, 0.5f); }},
    {"material too shiny", GL_INVALID_VALUE,
     [](Context& c) { op::material(c, GL_BACK, GL_SHININESS, std::array{128.5f}.data()); }},
    {"depth_func", GL_INVALID_ENUM, [](Context& c) { op::depth_func(c, GL_NEVER - 1); }},
    {"scissor width", GL_INVALID_VALUE, [](Context& c) { op::scissor(c, 1, 2, -3, 4); }},
    {"scissor height", GL_INVALID_VALUE, [](Context& c) { op::scissor(c, 1, 2, 3, -4); }},
    {"cull_face", GL_INVALID_ENUM, [](Context& c) { op::cull_face(c, GL_LEFT); }},
    {"front_face", GL_INVALID_ENUM, [](Context& c) { op::front_face(c, GL_BACK); }},
    {"polygon_mode face", GL_INVALID_ENUM, [](Context& c) { op::polygon_mode(c, GL_LEFT, GL_LINE); }},
    {"polygon_mode mode", GL_INVALID_ENUM, [](Context& c) { op::polygon_mode(c, GL_FRONT, GL_LINES); }},
    {"shade_model", GL_INVALID_ENUM, [](Context& c) { op::shade_model(c, GL_FILL); }},
    {"hint target", GL_INVALID_ENUM, [](Context& c) { op::hint(c, GL_FOG, GL_NICEST); }},
    {"hint mode", GL_INVALID_ENUM, [](Context& c) { op::hint(c, GL_FOG_HINT, GL_FOG); }},
    {"enable", GL_INVALID_ENUM, [](Context& c) { op::enable(c, GL_RGBA); }},
    {"disable", GL_INVALID_ENUM, [](Context& c) { op::disable(c, GL_RGBA); }},
    {"is_enabled", GL_INVALID_ENUM, [](Context& c) { EXPECT_EQ(op::is_enabled(c, GL_RGBA), GL_FALSE); }},
    {"draw_buffer", GL_INVALID_ENUM, [](Context& c) { op::draw_buffer(c, GL_RGBA); }},
    {"draw_buffer right", GL_INVALID_OPERATION, [](Context& c) { op::draw_buffer(c, GL_FRONT_RIGHT); }},
    {"draw_buffer auxiliary", GL_INVALID_OPERATION, [](Context& c) { op::draw_buffer(c, GL_AUX0); }},
    {"draw_buffer back of one", GL_INVALID_OPERATION, [](Context& c) { op::draw_buffer(c, GL_BACK); }},
    {"read_buffer", GL_INVALID_ENUM, [](Context& c) { op::read_buffer(c, GL_FRONT_AND_BACK); }},
    {"read_buffer none", GL_INVALID_ENUM, [](Context& c) { op::read_buffer(c, GL_NONE); }},
    {"read_buffer back of one", GL_INVALID_OPERATION, [](Context& c) { op::read_buffer(c, GL_BACK_LEFT); }},
    {"get_string", GL_INVALID_ENUM, [](Context& c) { EXPECT_EQ(op::get_string(c, GL_RGBA), nullptr); }},
    {"get_booleanv", GL_INVALID_ENUM, [](Context& c) { op::get_booleanv(c, GL_RGBA, nullptr); }},
    {"get_integerv", GL_INVALID_ENUM, [](Context& c) { op::get_integerv(c, GL_RGBA, nullptr); }},
    {"get_floatv", GL_INVALID_ENUM, [](Context& c) { op::get_floatv(c, GL_RGBA, nullptr); }},
    {"get_doublev", GL_INVALID_ENUM, [](Context& c) { op::get_doublev(c, GL_RGBA, nullptr); }},
};

class RefusalTest : public StateTest {};

TEST_F(RefusalTest, RecordsTheErrorAndChangesNothing) {
  for (const Refusal& refusal : kRefusals) {
    const Snapshot before = take_snapshot(*context);
    refusal.call(*context);
    EXPECT_EQ(op::get_error(*context), refusal.error) << refusal.name;
    EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR)) << refusal.name;
    EXPECT_TRUE(take_snapshot(*context) == before) << refusal.name;
  }
}

TEST_F(RefusalTest, StackOverflowChangesNothing) {
  op::matrix_mode(*context, GL_TEXTURE);
  for (int i = 1; i < kMaxTextureDepth; ++i) op::push_matrix(*context);
  const Snapshot before = take_snapshot(*context);
  op::push_matrix(*context);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_STACK_OVERFLOW));
  EXPECT_TRUE(take_snapshot(*context) == before);
}

TEST_F(RefusalTest, TheFirstErrorStands) {
  op::shade_model(*context, 0);
  op::viewport(*context, 0, 0, -1, 0);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_INVALID_ENUM));
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

// The calls are valid outside Begin/End: what refuses them is the table that Begin swapped in.
TEST_F(RefusalTest, BetweenBeginAndEnd) {
  using Table = const OperationTable;
  using Call = std::function<void(Table&, Context&)>;
  const std::vector<std::pair<const char*, Call>> calls = {
      {"begin", [](Table& t, Context& c) { t.begin(c, GL_POINTS); }},
      {"rect", [](Table& t, Context& c) { t.rect(c, 0, 0, 1, 1); }},
      {"draw_arrays", [](Table& t, Context& c) { t.draw_arrays(c, GL_POINTS, 0, 1); }},
      {"draw_elements", [](Table& t, Context& c) { t.draw_elements(c, GL_POINTS, 1, GL_UNSIGNED_BYTE, ""); }},
      {"matrix_mode", [](Table& t, Context& c) { t.matrix_mode(c, GL_TEXTURE); }},
      {"load_identity", [](Table& t, Context& c) { t.load_identity(c); }},
      {"load_matrix", [](Table& t, Context& c) { t.load_matrix(c, kIdentityDouble); }},
      {"mult_matrix", [](Table& t, Context& c) { t.mult_matrix(c, kIdentityDouble); }},
      {"push_matrix", [](Table& t, Context& c) { t.push_matrix(c); }},
      {"pop_matrix", [](Table& t, Context& c) { t.pop_matrix(c); }},
      {"rotate", [](Table& t, Context& c) { t.rotate(c, 1, 1, 0, 0); }},
      {"scale", [](Table& t, Context& c) { t.scale(c, 2, 2, 2); }},
      {"translate", [](Table& t, Context& c) { t.translate(c, 2, 2, 2); }},
      {"frustum", [](Table& t, Context& c) { t.frustum(c, -1, 1, -1, 1, 1, 2); }},
      {"ortho", [](Table& t, Context& c) { t.ortho(c, -1, 1, -1, 1, 1, 2); }},
      {"viewport", [](Table& t, Context& c) { t.viewport(c, 1, 2, 3, 4); }},
      {"depth_range", [](Table& t, Context& c) { t.depth_range(c, 0.25, 0.5); }},
      {"alpha_func", [](Table& t, Context& c) { t.alpha_func(c, GL_LESS, 0.5f); }},
      {"blend_func", [](Table& t, Context& c) { t.blend_func(c, GL_ZERO, GL_ONE); }},
      {"depth_func", [](Table& t, Context& c) { t.depth_func(c, GL_EQUAL); }},
      {"depth_mask", [](Table& t, Context& c) { t.depth_mask(c, GL_FALSE); }},
      {"stencil_func", [](Table& t, Context& c) { t.stencil_func(c, GL_LESS, 1, 2); }},
      {"stencil_op", [](Table& t, Context& c) { t.stencil_op(c, GL_ZERO, GL_ZERO, GL_ZERO); }},
      {"stencil_mask", [](Table& t, Context& c) { t.stencil_mask(c, 1); }},
      {"logic_op", [](Table& t, Context& c) { t.logic_op(c, GL_XOR); }},
      {"fog", [](Table& t, Context& c) { t.fog(c, GL_FOG_COLOR, kOnes); }},
      {"clear_accum", [](Table& t, Context& c) { t.clear_accum(c, 1, 1, 1, 1); }},
      {"accum", [](Table& t, Context& c) { t.accum(c, GL_LOAD, 1); }},
      {"scissor", [](Table& t, Context& c) { t.scissor(c, 1, 2, 3, 4); }},
      {"color_mask", [](Table& t, Context& c) { t.color_mask(c, 0, 0, 0, 0); }},
      {"cull_face", [](Table& t, Context& c) { t.cull_face(c, GL_FRONT); }},
      {"front_face", [](Table& t, Context& c) { t.front_face(c, GL_CW); }},
      {"polygon_mode", [](Table& t, Context& c) { t.polygon_mode(c, GL_FRONT, GL_LINE); }},
      {"shade_model", [](Table& t, Context& c) { t.shade_model(c, GL_FLAT); }},
      {"light", [](Table& t, Context& c) { t.light(c, GL_LIGHT0, GL_AMBIENT, kOnes); }},
      {"light_model", [](Table& t, Context& c) { t.light_model(c, GL_LIGHT_MODEL_AMBIENT, kOnes); }},
      {"color_material", [](Table& t, Context& c) { t.color_material(c, GL_FRONT, GL_AMBIENT); }},
      {"tex_gen", [](Table& t, Context& c) { t.tex_gen(c, GL_S, GL_EYE_PLANE, kIdentityDouble); }},
      {"hint", [](Table& t, Context& c) { t.hint(c, GL_FOG_HINT, GL_NICEST); }},
      {"enable", [](Table& t, Context& c) { t.enable(c, GL_BLEND); }},
      {"disable", [](Table& t, Context& c) { t.disable(c, GL_DITHER); }},
      {"is_enabled", [](Table& t, Context& c) { EXPECT_EQ(t.is_enabled(c, GL_DITHER), GL_FALSE); }},
      {"clear_color", [](Table& t, Context& c) { t.clear_color(c, 1, 1, 1, 1); }},
      {"clear_depth", [](Table& t, Context& c) { t.clear_depth(c, 0.5); }},
      {"clear_stencil", [](Table& t, Context& c) { t.clear_stencil(c, 5); }},
      {"clear_index", [](Table& t, Context& c) { t.clear_index(c, 5); }},
      {"draw_buffer", [](Table& t, Context& c) { t.draw_buffer(c, GL_NONE); }},
      {"read_buffer", [](Table& t, Context& c) { t.read_buffer(c, GL_FRONT_LEFT); }},
      {"finish", [](Table& t, Context& c) { t.finish(c); }},
      {"flush", [](Table& t, Context& c) { t.flush(c); }},
      {"get_string", [](Table& t, Context& c) { EXPECT_EQ(t.get_string(c, GL_VENDOR), nullptr); }},
      {"get_error", [](Table& t, Context& c) { EXPECT_EQ(t.get_error(c), 0u); }},
      {"get_booleanv", [](Table& t, Context& c) { t.get_booleanv(c, GL_BLEND, nullptr); }},
      {"get_integerv", [](Table& t, Context& c) { t.get_integerv(c, GL_BLEND, nullptr); }},
      {"get_floatv", [](Table& t, Context& c) { t.get_floatv(c, GL_BLEND, nullptr); }},
      {"get_doublev", [](Table& t, Context& c) { t.get_doublev(c, GL_BLEND, nullptr); }},
  };
  op::begin(*context, GL_TRIANGLES);
  ASSERT_EQ(current_binding.table, &kInsideBeginEndTable);
  for (const auto& [name, call] : calls) {
    const Snapshot before = take_snapshot(*context);
    call(*current_binding.table, *context);
    EXPECT_EQ(op::get_error(*context), GLenum(GL_INVALID_OPERATION)) << name;
    EXPECT_TRUE(take_snapshot(*context) == before) << name;
  }
  current_binding.table->end(*context);
  EXPECT_EQ(current_binding.table, &kExecuteTable);
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

}  // namespace
}  // namespace halfspace::state
