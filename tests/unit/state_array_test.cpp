// Client arrays: every type, size and stride against the conversions of table 2.6, indices of every type, and
// arrays that are not there.
#include <sys/mman.h>

#include <cstdint>
#include <limits>
#include <random>

#include "recording_device.h"
#include "state_fixture.h"

namespace halfspace::state {
namespace {

using raster::recorded_draws;

class ArrayTest : public StateTest {
 protected:
  ArrayTest() { recorded_draws.clear(); }
  void use_positions(const std::vector<float>& xyzw) {
    op::vertex_pointer(*context, 4, GL_FLOAT, 0, xyzw.data());
    op::enable_client_state(*context, GL_VERTEX_ARRAY);
  }
  // x = 0, 1, 2 ...
  static std::vector<float> numbered(size_t count) {
    std::vector<float> xyzw(4 * count, 1.0f);
    for (size_t i = 0; i < count; ++i) xyzw[4 * i] = float(i);
    return xyzw;
  }
  static std::vector<uint32_t> drawn_numbers() {
    std::vector<uint32_t> numbers;
    for (const auto& v : recorded_draws.back().vertices) numbers.push_back(uint32_t(v.position[0]));
    return numbers;
  }
};

template <class T>
long double truth(T v, bool normalized) {
  if (!normalized || std::is_floating_point_v<T>) return (long double)(v);
  const long double range =
      (long double)(std::numeric_limits<
                    std::make_unsigned_t<std::conditional_t<std::is_floating_point_v<T>, int, T>>>::max());
  return std::is_signed_v<T> ? (2 * (long double)(v) + 1) / range : (long double)(v) / range;
}

// `count` elements of `size` Ts, `padding` bytes apart, starting at an odd address.
template <class T>
struct OddArray {
  OddArray(int element_size, size_t padding)
      : size(element_size), stride(size_t(size) * sizeof(T) + padding) {
    bytes.resize(kCount * stride + 1);
    std::mt19937_64 random(5);
    for (size_t i = 0; i < kCount * size_t(size); ++i) {
      T v;
      if constexpr (std::is_floating_point_v<T>) {
        v = std::uniform_real_distribution<T>(-3, 3)(random);
      } else {
        const T extremes[] = {std::numeric_limits<T>::max(), std::numeric_limits<T>::min(), 0};
        v = i < 3 ? extremes[i] : T(random());
      }
      values.push_back(v);
      std::memcpy(bytes.data() + 1 + i / size_t(size) * stride + i % size_t(size) * sizeof(T), &v, sizeof v);
    }
  }
  static constexpr size_t kCount = 9;
  int size;
  size_t stride;
  std::vector<std::byte> bytes;
  std::vector<T> values;
  const void* pointer() const { return bytes.data() + 1; }
};

template <class T>
void check_values(const OddArray<T>& array, bool normalized,
                  std::array<float, 4> raster::RecordedVertex::*member, size_t first) {
  const auto& vertices = recorded_draws.back().vertices;
  for (size_t i = 0; i < vertices.size(); ++i) {
    for (size_t k = 0; k < 4; ++k) {
      const float value = (vertices[i].*member)[k];
      if (k >= size_t(array.size)) {
        EXPECT_EQ(value, k == 3 ? 1.0f : 0.0f);
        continue;
      }
      const long double want = truth(array.values[(first + i) * size_t(array.size) + k], normalized);
      EXPECT_NEAR(double(value), double(want), 6.0e-8 * std::fabs(double(want)));
      if (normalized && want == 1) {
        EXPECT_EQ(value, 1.0f);
      }
    }
  }
}

template <class T>
void check_type(Context& context, GLenum type, bool as_color, bool as_position) {
  const std::vector<float> positions(64, 0.0f);
  for (size_t padding : {size_t{0}, size_t{3}}) {
    for (int size = 2; size <= 4; ++size) {
      const OddArray<T> array(size, padding);
      const GLsizei stride = padding ? GLsizei(array.stride) : 0;
      if (as_position) {
        op::disable_client_state(context, GL_COLOR_ARRAY);
        op::vertex_pointer(context, size, type, stride, array.pointer());
        op::draw_arrays(context, GL_POINTS, 2, 5);
        check_values(array, false, &raster::RecordedVertex::position, 2);
        op::tex_coord_pointer(context, size, type, stride, array.pointer());
        op::enable_client_state(context, GL_TEXTURE_COORD_ARRAY);
        op::draw_arrays(context, GL_POINTS, 1, 6);
        check_values(array, false, &raster::RecordedVertex::tex_coord, 1);
        op::disable_client_state(context, GL_TEXTURE_COORD_ARRAY);
      }
      if (as_color && size >= 3) {
        op::vertex_pointer(context, 4, GL_FLOAT, 0, positions.data());
        op::color_pointer(context, size, type, stride, array.pointer());
        op::enable_client_state(context, GL_COLOR_ARRAY);
        op::draw_arrays(context, GL_POINTS, 0, 9);
        check_values(array, true, &raster::RecordedVertex::color, 0);
      }
    }
  }
  EXPECT_EQ(op::get_error(context), GLenum(GL_NO_ERROR));
}

TEST_F(ArrayTest, EveryTypeSizeAndStride) {
  op::enable_client_state(*context, GL_VERTEX_ARRAY);
  op::enable(*context, GL_TEXTURE_2D);
  check_type<GLbyte>(*context, GL_BYTE, true, false);
  check_type<GLubyte>(*context, GL_UNSIGNED_BYTE, true, false);
  check_type<GLshort>(*context, GL_SHORT, true, true);
  check_type<GLushort>(*context, GL_UNSIGNED_SHORT, true, false);
  check_type<GLint>(*context, GL_INT, true, true);
  check_type<GLuint>(*context, GL_UNSIGNED_INT, true, false);
  check_type<GLfloat>(*context, GL_FLOAT, true, true);
  check_type<GLdouble>(*context, GL_DOUBLE, true, true);
}

TEST_F(ArrayTest, FloatsAreNotCopied) {
  const auto positions = numbered(8);
  use_positions(positions);
  op::draw_arrays(*context, GL_POINTS, 3, 2);
  EXPECT_EQ(recorded_draws.back().position_data, positions.data() + 12);
  EXPECT_EQ(drawn_numbers(), (std::vector<uint32_t>{3, 4}));
}

TEST_F(ArrayTest, CurrentValuesStandInForArraysThatAreOff) {
  const auto positions = numbered(3);
  use_positions(positions);
  op::color(*context, 0.5f, 0.25f, 2, 1);
  op::draw_arrays(*context, GL_TRIANGLES, 0, 3);
  EXPECT_TRUE(recorded_draws.back().constant_color);
  EXPECT_EQ(recorded_draws.back().vertices[2].color, (std::array<float, 4>{0.5f, 0.25f, 2, 1}));
  EXPECT_FALSE(recorded_draws.back().has_tex_coord);
}

template <class T>
std::vector<T> pattern(size_t lowest, size_t highest, size_t count) {
  std::mt19937 random(11);
  std::vector<T> indices(count);
  for (T& i : indices) i = T(lowest + random() % (highest - lowest + 1));
  indices[count / 2] = T(highest);
  indices[count / 3] = T(lowest);
  return indices;
}

TEST_F(ArrayTest, IndicesOfEveryTypeAndRange) {
  const auto positions = numbered(300'000);
  use_positions(positions);
  const auto check = [&](auto indices, GLenum type, uint32_t most_vertices) {
    recorded_draws.clear();
    op::draw_elements(*context, GL_TRIANGLE_STRIP, GLsizei(indices.size()), type, indices.data());
    ASSERT_EQ(recorded_draws.size(), 1u);
    EXPECT_EQ(drawn_numbers(), std::vector<uint32_t>(indices.begin(), indices.end()));
    EXPECT_LE(recorded_draws.back().batch_count, most_vertices);
  };
  check(pattern<GLubyte>(0, 255, 500), GL_UNSIGNED_BYTE, 256);
  check(pattern<GLubyte>(200, 255, 20), GL_UNSIGNED_BYTE, 56);
  check(pattern<GLushort>(60'000, 65'535, 900), GL_UNSIGNED_SHORT, 5'536);
  check(pattern<GLuint>(0, 999, 3000), GL_UNSIGNED_INT, 1000);
  check(pattern<GLuint>(290'000, 299'999, 3000), GL_UNSIGNED_INT, 10'000);  // moved down
  check(pattern<GLuint>(0, 299'999, 6), GL_UNSIGNED_INT, 6);                // far apart: fetched one by one
}

TEST_F(ArrayTest, IndicesAtOddAddresses) {
  const auto positions = numbered(100);
  use_positions(positions);
  const auto indices = pattern<GLuint>(10, 99, 30);
  std::vector<std::byte> bytes(indices.size() * 4 + 1);
  std::memcpy(bytes.data() + 1, indices.data(), indices.size() * 4);
  op::draw_elements(*context, GL_POINTS, 30, GL_UNSIGNED_INT, bytes.data() + 1);
  EXPECT_EQ(drawn_numbers(), indices);
}

TEST_F(ArrayTest, ArrayElementIsTheImmediateCalls) {
  const auto positions = numbered(6);
  const GLubyte colors[] = {255, 0, 0, 128, 0, 255, 0, 255, 0, 0, 255, 0};
  use_positions(positions);
  op::color_pointer(*context, 4, GL_UNSIGNED_BYTE, 0, colors);
  op::enable_client_state(*context, GL_COLOR_ARRAY);
  op::begin(*context, GL_TRIANGLES);
  for (GLint i : {2, 0, 1}) current_binding.table->array_element(*context, i);
  op::end(*context);
  op::flush(*context);
  ASSERT_EQ(recorded_draws.size(), 1u);
  EXPECT_EQ(drawn_numbers(), (std::vector<uint32_t>{2, 0, 1}));
  EXPECT_EQ(recorded_draws[0].vertices[1].color, (std::array<float, 4>{1, 0, 0, 128 / 255.0f}));
  EXPECT_EQ(context->current.color[1], 1.0f);  // element 1's colour is current now
}

TEST_F(ArrayTest, InterleavedFormatsMatchTable25) {
  // Name, then the floats (a colour of bytes counts as one) before each part; -1: not there; and the total.
  struct Layout {
    GLenum format;
    int tex_coord, tex_coord_size, color, color_size, normal, vertex, vertex_size, total;
  };
  const Layout layouts[] = {
      {GL_V2F, -1, 0, -1, 0, -1, 0, 2, 2},           {GL_V3F, -1, 0, -1, 0, -1, 0, 3, 3},
      {GL_C4UB_V2F, -1, 0, 0, -4, -1, 1, 2, 3},      {GL_C4UB_V3F, -1, 0, 0, -4, -1, 1, 3, 4},
      {GL_C3F_V3F, -1, 0, 0, 3, -1, 3, 3, 6},        {GL_N3F_V3F, -1, 0, -1, 0, 0, 3, 3, 6},
      {GL_C4F_N3F_V3F, -1, 0, 0, 4, 4, 7, 3, 10},    {GL_T2F_V3F, 0, 2, -1, 0, -1, 2, 3, 5},
      {GL_T4F_V4F, 0, 4, -1, 0, -1, 4, 4, 8},        {GL_T2F_C4UB_V3F, 0, 2, 2, -4, -1, 3, 3, 6},
      {GL_T2F_C3F_V3F, 0, 2, 2, 3, -1, 5, 3, 8},     {GL_T2F_N3F_V3F, 0, 2, -1, 0, 2, 5, 3, 8},
      {GL_T2F_C4F_N3F_V3F, 0, 2, 2, 4, 6, 9, 3, 12}, {GL_T4F_C4F_N3F_V4F, 0, 4, 4, 4, 8, 11, 4, 15},
  };
  const char* base = reinterpret_cast<const char*>(uintptr_t{4096});
  const VertexArrayState& arrays = context->vertex_array;
  const auto expect = [&](const ClientArray& array, int offset, int size, GLenum type, int stride) {
    EXPECT_EQ(array.enabled, offset >= 0);
    if (offset < 0) return;
    EXPECT_EQ(array.pointer, base + 4 * offset);
    EXPECT_EQ(array.size, size);
    EXPECT_EQ(array.type, type);
    EXPECT_EQ(array.stride, stride);
  };
  for (const Layout& l : layouts) {
    for (GLsizei stride : {0, 100}) {
      SCOPED_TRACE(l.format - GL_V2F);
      op::enable_client_state(*context, GL_EDGE_FLAG_ARRAY);
      op::enable_client_state(*context, GL_INDEX_ARRAY);
      op::interleaved_arrays(*context, l.format, stride, base);
      const int step = stride ? stride : 4 * l.total;
      expect(arrays.tex_coord, l.tex_coord, l.tex_coord_size, GL_FLOAT, step);
      expect(arrays.color, l.color, std::abs(l.color_size), l.color_size < 0 ? GL_UNSIGNED_BYTE : GL_FLOAT,
             step);
      expect(arrays.normal, l.normal, 3, GL_FLOAT, step);
      expect(arrays.vertex, l.vertex, l.vertex_size, GL_FLOAT, step);
      EXPECT_FALSE(arrays.edge_flag.enabled || arrays.index.enabled);
    }
  }
  EXPECT_EQ(op::get_error(*context), GLenum(GL_NO_ERROR));
}

TEST_F(ArrayTest, WithoutAVertexArrayNothingIsDrawn) {
  op::draw_arrays(*context, GL_POINTS, 0, 3);
  const GLubyte indices[] = {0, 1, 2};
  op::draw_elements(*context, GL_POINTS, 3, GL_UNSIGNED_BYTE, indices);
  EXPECT_TRUE(recorded_draws.empty());
}

TEST_F(ArrayTest, NullArraysDrawNothingAndTheNextDrawIsRight) {
  const auto positions = numbered(3);
  const GLubyte indices[] = {0, 1, 2};
  op::enable_client_state(*context, GL_VERTEX_ARRAY);
  op::draw_arrays(*context, GL_POINTS, 0, 3);
  op::draw_elements(*context, GL_POINTS, 3, GL_UNSIGNED_BYTE, indices);
  op::begin(*context, GL_POINTS);
  op::array_element(*context, 1);
  op::end(*context);
  op::flush(*context);
  use_positions(positions);
  op::enable_client_state(*context, GL_COLOR_ARRAY);
  op::draw_arrays(*context, GL_POINTS, 0, 3);
  op::disable_client_state(*context, GL_COLOR_ARRAY);
  op::draw_elements(*context, GL_POINTS, 3, GL_UNSIGNED_BYTE, nullptr);
  EXPECT_TRUE(recorded_draws.empty());
  op::draw_elements(*context, GL_POINTS, 3, GL_UNSIGNED_BYTE, indices);
  EXPECT_EQ(drawn_numbers(), (std::vector<uint32_t>{0, 1, 2}));
}

TEST_F(ArrayTest, AnIndexOutOfAllMemoryDrawsNothing) {
  // Three vertices at the end of a page, behind it a page that nobody may read.
  const size_t page = 4096;
  auto* pages =
      static_cast<char*>(mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(pages, MAP_FAILED);
  ASSERT_EQ(mprotect(pages + page, page, PROT_NONE), 0);
  op::vertex_pointer(*context, 4, GL_FLOAT, 0, pages + page - 48);
  op::enable_client_state(*context, GL_VERTEX_ARRAY);
  const GLuint good[] = {0, 1, 2}, near[] = {0, 1, 3}, far[] = {0, 1, 0xffffffffu};
  op::draw_elements(*context, GL_TRIANGLES, 3, GL_UNSIGNED_INT, near);
  op::draw_elements(*context, GL_TRIANGLES, 3, GL_UNSIGNED_INT, far);
  op::draw_arrays(*context, GL_POINTS, 0, 4);
  EXPECT_TRUE(recorded_draws.empty());
  op::draw_elements(*context, GL_TRIANGLES, 3, GL_UNSIGNED_INT, good);
  EXPECT_EQ(recorded_draws.size(), 1u);
  munmap(pages, 2 * page);
}

TEST_F(ArrayTest, PointersAreReadBack) {
  const GLenum names[] = {GL_VERTEX_ARRAY_POINTER,    GL_COLOR_ARRAY_POINTER,
                          GL_NORMAL_ARRAY_POINTER,    GL_INDEX_ARRAY_POINTER,
                          GL_EDGE_FLAG_ARRAY_POINTER, GL_TEXTURE_COORD_ARRAY_POINTER};
  static const char places[6] = {};
  op::vertex_pointer(*context, 3, GL_SHORT, 6, places + 0);
  op::color_pointer(*context, 3, GL_UNSIGNED_BYTE, 6, places + 1);
  op::normal_pointer(*context, GL_BYTE, 6, places + 2);
  op::index_pointer(*context, GL_UNSIGNED_BYTE, 6, places + 3);
  op::edge_flag_pointer(*context, 6, places + 4);
  op::tex_coord_pointer(*context, 2, GL_INT, 6, places + 5);
  for (size_t i = 0; i < 6; ++i) {
    void* pointer = nullptr;
    op::get_pointerv(*context, names[i], &pointer);
    EXPECT_EQ(pointer, places + i);
  }
}

// Normals and edge flags come where the state calls for them, from the array or from the current value.
TEST_F(ArrayTest, NormalsAndEdgeFlags) {
  const auto positions = numbered(3000);
  std::vector<GLbyte> normals(3 * 3000);
  std::vector<GLubyte> flags(2 * 3000);  // every other byte
  for (size_t i = 0; i < 3000; ++i) {
    normals[3 * i + 2] = GLbyte(i % 100);
    flags[2 * i] = i % 3 == 1 ? 7 : 0;
    flags[2 * i + 1] = 1;
  }
  use_positions(positions);
  op::normal_pointer(*context, GL_BYTE, 0, normals.data());
  op::edge_flag_pointer(*context, 2, flags.data());
  const GLushort near_indices[] = {5, 4, 7}, far_indices[] = {5, 2999, 4};
  for (bool arrays : {false, true}) {
    for (GLenum name : std::initializer_list<GLenum>{GL_NORMAL_ARRAY, GL_EDGE_FLAG_ARRAY}) {
      (arrays ? op::enable_client_state : op::disable_client_state)(*context, name);
    }
    for (GLboolean flag : {GLboolean{1}, GLboolean{0}}) {
      for (bool wanted : {false, true}) {
        (wanted ? op::enable : op::disable)(*context, GL_LIGHTING);
        op::polygon_mode(*context, GL_FRONT, wanted ? GL_POINT : GL_FILL);
        op::normal(*context, 1, 2, 3);
        op::edge_flag(*context, flag);
        recorded_draws.clear();
        op::draw_arrays(*context, GL_TRIANGLES, 4, 3);
        op::draw_elements(*context, GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, near_indices);
        op::draw_elements(*context, GL_TRIANGLES, 3, GL_UNSIGNED_SHORT, far_indices);
        ASSERT_EQ(recorded_draws.size(), 3u);
        for (const auto& draw : recorded_draws) {
          EXPECT_EQ(draw.has_normal, wanted);
          for (const auto& v : draw.vertices) {
            if (!wanted) continue;
            const auto i = size_t(v.position[0]);
            const float z = float(2 * int(i % 100) + 1) / 255.0f, zero = 1 / 255.0f;
            const std::array<float, 4> current{1, 2, 3, 1}, element{zero, zero, z, 1};
            EXPECT_EQ(v.normal, arrays ? element : current);
            EXPECT_EQ(v.edge_flag, arrays ? i % 3 == 1 : flag != 0);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::state
