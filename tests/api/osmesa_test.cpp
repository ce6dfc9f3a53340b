// OSMesa: what GL/osmesa.h documents, and what Mesa's own does where the header is silent.
#include <cstring>
#include <thread>

#include "tests/api/osmesa_context.h"

namespace halfspace::test {
namespace {

// A context that goes with the test.
struct Context {
  explicit Context(OSMesaContext context) : handle(context) {}
  ~Context() {
    if (handle) OSMesaDestroyContext(handle);
  }
  OSMesaContext handle;
};

struct FormatCase {
  GLenum format, type;
  size_t pixel_bytes;
  std::vector<GLubyte> expected;  // the bytes of colour (1, 0.2, 0.4, 0.6): 255, 51, 102, 153
};

std::vector<GLubyte> bytes_of(const std::vector<float>& values) {
  std::vector<GLubyte> bytes(values.size() * sizeof(float));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<GLubyte> bytes_of_shorts(const std::vector<GLushort>& values) {
  std::vector<GLubyte> bytes(values.size() * sizeof(GLushort));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::vector<FormatCase> format_cases() {
  const float r = 1.0f, g = 0.2f, b = 0.4f, a = 0.6f;
  // 0.2 * 65535 = 13107, 0.4 * 65535 = 26214, 0.6 * 65535 = 39321; in 5-6-5: 31, 0.2 * 63 = 12.6, 0.4 * 31
  // = 12.4.
  return {
      {OSMESA_RGBA, GL_UNSIGNED_BYTE, 4, {255, 51, 102, 153}},
      {OSMESA_BGRA, GL_UNSIGNED_BYTE, 4, {102, 51, 255, 153}},
      {OSMESA_ARGB, GL_UNSIGNED_BYTE, 4, {153, 255, 51, 102}},
      {OSMESA_RGB, GL_UNSIGNED_BYTE, 3, {255, 51, 102}},
      {OSMESA_BGR, GL_UNSIGNED_BYTE, 3, {102, 51, 255}},
      {OSMESA_RGB_565, GL_UNSIGNED_SHORT_5_6_5, 2, bytes_of_shorts({(31 << 11) | (13 << 5) | 12})},
      {OSMESA_RGBA, GL_FLOAT, 16, bytes_of({r, g, b, a})},
      {OSMESA_BGRA, GL_FLOAT, 16, bytes_of({b, g, r, a})},
      {OSMESA_ARGB, GL_FLOAT, 16, bytes_of({a, r, g, b})},
      {OSMESA_RGB, GL_FLOAT, 12, bytes_of({r, g, b})},
      {OSMESA_BGR, GL_FLOAT, 12, bytes_of({b, g, r})},
      {OSMESA_RGBA, GL_UNSIGNED_SHORT, 8, bytes_of_shorts({65535, 13107, 26214, 39321})},
      {OSMESA_BGR, GL_UNSIGNED_SHORT, 6, bytes_of_shorts({26214, 13107, 65535})},
  };
}

TEST(OsmesaFormats, EveryFormatStoresItsComponentsInOrder) {
  for (const FormatCase& c : format_cases()) {
    SCOPED_TRACE(testing::Message() << "format " << c.format << " type " << c.type);
    const Context context(OSMesaCreateContext(c.format, nullptr));
    ASSERT_NE(context.handle, nullptr);
    const size_t row = 5 * c.pixel_bytes;
    std::vector<GLubyte> buffer(3 * row + 7, 0xEE);
    ASSERT_TRUE(OSMesaMakeCurrent(context.handle, buffer.data(), c.type, 5, 3));
    assert_halfspace();
    clear_all(0, 0, 0, 0);
    clear_pixel(3, 1, 1.0f, 0.2f, 0.4f, 0.6f);
    glFinish();
    const GLubyte* pixel = buffer.data() + row + 3 * c.pixel_bytes;
    EXPECT_EQ(std::vector<GLubyte>(pixel, pixel + c.pixel_bytes), c.expected);
    for (size_t i = 0; i < 3 * row; ++i) {
      const bool inside = i >= row + 3 * c.pixel_bytes && i < row + 4 * c.pixel_bytes;
      if (!inside) {
        ASSERT_EQ(buffer[i], 0) << "byte " << i;
      }
    }
    for (size_t i = 3 * row; i < buffer.size(); ++i) ASSERT_EQ(buffer[i], 0xEE) << "beyond the buffer";
    OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  }
}

TEST(OsmesaFormats, TypesThatDoNotGoWithTheFormatAreRefused) {
  GLubyte buffer[64];
  const Context rgba(OSMesaCreateContext(OSMESA_RGBA, nullptr));
  EXPECT_FALSE(OSMesaMakeCurrent(rgba.handle, buffer, GL_UNSIGNED_SHORT_5_6_5, 2, 2));
  EXPECT_FALSE(OSMesaMakeCurrent(rgba.handle, buffer, GL_UNSIGNED_INT, 2, 2));
  const Context packed(OSMesaCreateContext(OSMESA_RGB_565, nullptr));
  EXPECT_FALSE(OSMesaMakeCurrent(packed.handle, buffer, GL_UNSIGNED_BYTE, 2, 2));
  EXPECT_FALSE(OSMesaMakeCurrent(packed.handle, buffer, GL_FLOAT, 2, 2));
  EXPECT_EQ(OSMesaGetCurrentContext(), nullptr);
}

TEST(OsmesaCreate, BadArgumentsGiveNoContext) {
  EXPECT_EQ(OSMesaCreateContext(OSMESA_COLOR_INDEX, nullptr), nullptr);
  EXPECT_EQ(OSMesaCreateContext(0x1234, nullptr), nullptr);
  EXPECT_EQ(OSMesaCreateContextExt(OSMESA_RGBA, -1, 0, 0, nullptr), nullptr);
  EXPECT_EQ(OSMesaCreateContextExt(OSMESA_RGBA, 24, -8, 0, nullptr), nullptr);
  const std::vector<std::vector<int>> refused = {
      {0x999, 1, 0},
      {OSMESA_FORMAT, OSMESA_COLOR_INDEX, 0},
      {OSMESA_DEPTH_BITS, -1, 0},
      {OSMESA_PROFILE, OSMESA_CORE_PROFILE, 0},
      {OSMESA_PROFILE, 0x99, 0},
      {OSMESA_CONTEXT_MAJOR_VERSION, 0, 0},
      {OSMESA_CONTEXT_MAJOR_VERSION, 3, 0},
      {OSMESA_CONTEXT_MINOR_VERSION, -1, 0},
  };
  for (const std::vector<int>& list : refused) {
    EXPECT_EQ(OSMesaCreateContextAttribs(list.data(), nullptr), nullptr) << list[0] << " " << list[1];
  }
}

TEST(OsmesaCreate, AttributesAreTaken) {
  const int list[] = {OSMESA_FORMAT,
                      OSMESA_BGRA,
                      OSMESA_DEPTH_BITS,
                      24,
                      OSMESA_PROFILE,
                      OSMESA_COMPAT_PROFILE,
                      OSMESA_CONTEXT_MAJOR_VERSION,
                      1,
                      OSMESA_CONTEXT_MINOR_VERSION,
                      1,
                      0};
  const Context context(OSMesaCreateContextAttribs(list, nullptr));
  ASSERT_NE(context.handle, nullptr);
  GLuint pixel = 0;
  ASSERT_TRUE(OSMesaMakeCurrent(context.handle, &pixel, GL_UNSIGNED_BYTE, 1, 1));
  GLint format = 0, depth_bits = 0;
  OSMesaGetIntegerv(OSMESA_FORMAT, &format);
  EXPECT_EQ(format, OSMESA_BGRA);
  glGetIntegerv(GL_DEPTH_BITS, &depth_bits);
  EXPECT_EQ(depth_bits, 24);
  const Context defaults(OSMesaCreateContextAttribs(nullptr, nullptr));
  EXPECT_NE(defaults.handle, nullptr);
}

TEST_F(OsmesaTest, BadArgumentsAreRefusedAndTheBindingStands) {
  EXPECT_FALSE(OSMesaMakeCurrent(nullptr, buffer_.data(), GL_UNSIGNED_BYTE, 2, 2));
  EXPECT_FALSE(OSMesaMakeCurrent(context_, nullptr, GL_UNSIGNED_BYTE, 2, 2));
  EXPECT_FALSE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, 0, 2));
  EXPECT_FALSE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, 2, -1));
  EXPECT_FALSE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, 16385, 1));
  EXPECT_FALSE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, 1, 1 << 30));
  EXPECT_EQ(OSMesaGetCurrentContext(), context_);
  clear_all(1, 1, 1, 1);
  glFinish();
  EXPECT_EQ(buffer_, std::vector<GLubyte>(buffer_.size(), 255));
}

TEST_F(OsmesaTest, QueriesSayWhatIsBound) {
  const auto get = [](GLint name) {
    GLint value = -7;
    OSMesaGetIntegerv(name, &value);
    return value;
  };
  EXPECT_EQ(get(OSMESA_WIDTH), kWidth);
  EXPECT_EQ(get(OSMESA_HEIGHT), kHeight);
  EXPECT_EQ(get(OSMESA_FORMAT), OSMESA_RGBA);
  EXPECT_EQ(get(OSMESA_TYPE), GL_UNSIGNED_BYTE);
  EXPECT_EQ(get(OSMESA_ROW_LENGTH), 0);
  EXPECT_EQ(get(OSMESA_Y_UP), 1);
  EXPECT_EQ(get(OSMESA_MAX_WIDTH), 16384);
  EXPECT_EQ(get(OSMESA_MAX_HEIGHT), 16384);
  EXPECT_EQ(get(0x99), -7);
  GLint width = 0, height = 0, format = 0;
  void* buffer = nullptr;
  EXPECT_TRUE(OSMesaGetColorBuffer(context_, &width, &height, &format, &buffer));
  EXPECT_EQ(width, kWidth);
  EXPECT_EQ(height, kHeight);
  EXPECT_EQ(format, OSMESA_RGBA);
  EXPECT_EQ(buffer, buffer_.data());
  EXPECT_FALSE(OSMesaGetColorBuffer(nullptr, &width, &height, &format, &buffer));
  EXPECT_EQ(buffer, nullptr);
}

TEST_F(OsmesaTest, RowLengthAndDirection) {
  constexpr int kRow = kWidth + 2;
  std::vector<GLubyte> buffer(kRow * kHeight * 4, 0xEE);
  OSMesaPixelStore(OSMESA_ROW_LENGTH, kRow);
  OSMesaPixelStore(OSMESA_Y_UP, 0);
  OSMesaPixelStore(OSMESA_ROW_LENGTH, -1);  // refused
  GLint value = 0;
  OSMesaGetIntegerv(OSMESA_ROW_LENGTH, &value);
  EXPECT_EQ(value, kRow);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer.data(), GL_UNSIGNED_BYTE, kWidth, kHeight));
  clear_all(0, 0, 0, 0);
  clear_pixel(1, 0, 1, 1, 1, 1);
  glFinish();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kRow; ++x) {
      int expected = x < kWidth ? 0 : 0xEE;
      if (x == 1 && y == kHeight - 1) expected = 255;
      EXPECT_EQ(buffer[static_cast<size_t>((y * kRow + x) * 4)], expected) << x << ", " << y;
    }
  }
}

TEST_F(OsmesaTest, FlushAndReleaseShowThePicture) {
  clear_all(1, 1, 1, 1);
  glFlush();
  EXPECT_EQ(buffer_[0], 255);
  clear_all(0, 0, 0, 0);
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  EXPECT_EQ(buffer_[0], 0);
  EXPECT_EQ(OSMesaGetCurrentContext(), nullptr);
  glClear(GL_COLOR_BUFFER_BIT);  // without a context: nothing, and no crash
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(OsmesaTest, BindingTheSameBufferAgainKeepsThePicture) {
  clear_all(0, 0, 0, 0);
  clear_pixel(2, 1, 1, 1, 1, 1);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kWidth, kHeight));
  glFinish();
  EXPECT_EQ(buffer_[(1 * kWidth + 2) * 4], 255);
  EXPECT_EQ(buffer_[0], 0);
}

// Callers free the old buffer first and bind the new one then: nothing may be written to the old.
TEST_F(OsmesaTest, BindingAnotherBufferLeavesTheOldAlone) {
  clear_all(1, 1, 1, 1);
  std::vector<GLubyte> same_size(buffer_.size(), 0);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, same_size.data(), GL_UNSIGNED_BYTE, kWidth, kHeight));
  glFinish();
  EXPECT_EQ(buffer_, std::vector<GLubyte>(buffer_.size(), 0xEE));
  EXPECT_EQ(same_size, std::vector<GLubyte>(buffer_.size(), 255)) << "same size: the picture stays";

  clear_all(0, 0, 0, 0);
  std::vector<GLubyte> larger(100 * 70 * 4, 0x55);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, larger.data(), GL_UNSIGNED_BYTE, 100, 70));
  EXPECT_EQ(same_size[0], 255);
  clear_all(0.2f, 0.2f, 0.2f, 0.2f);
  glFinish();
  EXPECT_EQ(larger, std::vector<GLubyte>(larger.size(), 51));
}

TEST_F(OsmesaTest, ChangingTheTypeWorks) {
  std::vector<float> floats(kWidth * kHeight * 4, -1.0f);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, floats.data(), GL_FLOAT, kWidth, kHeight));
  clear_all(0.1f, 0.2f, 0.3f, 0.4f);
  glFinish();
  EXPECT_EQ(floats[0], 0.1f);
  EXPECT_EQ(floats[floats.size() - 1], 0.4f);
  GLint bits = 0;
  glGetIntegerv(GL_RED_BITS, &bits);
  EXPECT_EQ(bits, 32);
}

TEST(OsmesaDestroy, WhileCurrentAndAfterTheBufferIsGone) {
  OSMesaContext context = OSMesaCreateContext(OSMESA_RGBA, nullptr);
  {
    std::vector<GLubyte> buffer(64 * 64 * 4, 0xEE);
    ASSERT_TRUE(OSMesaMakeCurrent(context, buffer.data(), GL_UNSIGNED_BYTE, 64, 64));
    assert_halfspace();
    clear_all(1, 1, 1, 1);
  }
  OSMesaDestroyContext(context);  // a sanitizer would see a write to the buffer
  EXPECT_EQ(OSMesaGetCurrentContext(), nullptr);
  EXPECT_EQ(glGetString(GL_RENDERER), nullptr);
  OSMesaDestroyContext(nullptr);
}

TEST(OsmesaDestroy, WhileCurrentDoesNotTouchTheBuffer) {
  OSMesaContext context = OSMesaCreateContext(OSMESA_RGBA, nullptr);
  std::vector<GLubyte> buffer(8 * 8 * 4, 0xEE);
  ASSERT_TRUE(OSMesaMakeCurrent(context, buffer.data(), GL_UNSIGNED_BYTE, 8, 8));
  clear_all(1, 1, 1, 1);
  OSMesaDestroyContext(context);
  EXPECT_EQ(buffer, std::vector<GLubyte>(buffer.size(), 0xEE));
}

TEST(OsmesaDepth, ValuesAreAsWideAsTheContextAskedFor) {
  struct Case {
    GLint asked;
    int bytes;
    GLuint quarter;  // 0.25 of the largest value, rounded to nearest
  };
  for (const Case& c : {Case{16, 2, 16384}, Case{24, 4, 4194304}, Case{32, 4, 4194304}}) {
    SCOPED_TRACE(c.asked);
    const Context context(OSMesaCreateContextExt(OSMESA_RGBA, c.asked, 0, 0, nullptr));
    std::vector<GLubyte> buffer(7 * 3 * 4);
    ASSERT_TRUE(OSMesaMakeCurrent(context.handle, buffer.data(), GL_UNSIGNED_BYTE, 7, 3));
    GLint bits = 0;
    glGetIntegerv(GL_DEPTH_BITS, &bits);
    EXPECT_EQ(bits, 24) << "never fewer";
    glClearDepth(0.25);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(4, 0, 1, 1);
    glClearDepth(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    GLint width = 0, height = 0, bytes = 0;
    void* values = nullptr;
    ASSERT_TRUE(OSMesaGetDepthBuffer(context.handle, &width, &height, &bytes, &values));
    EXPECT_EQ(width, 7);
    EXPECT_EQ(height, 3);
    ASSERT_EQ(bytes, c.bytes);
    const auto value = [&](size_t i) {
      return bytes == 2 ? static_cast<const GLushort*>(values)[i] : static_cast<const GLuint*>(values)[i];
    };
    EXPECT_EQ(value(0), c.quarter);
    EXPECT_EQ(value(4), bytes == 2 ? 65535u : 16777215u) << "the lowest row comes first";
    EXPECT_EQ(value(20), c.quarter);
  }
}

TEST(OsmesaDepth, NoneWhenNoneWasAskedFor) {
  const Context context(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr));
  GLint width = -1, height = -1, bytes = -1;
  void* values = &width;
  EXPECT_FALSE(OSMesaGetDepthBuffer(context.handle, &width, &height, &bytes, &values)) << "never bound";
  GLuint pixel = 0;
  ASSERT_TRUE(OSMesaMakeCurrent(context.handle, &pixel, GL_UNSIGNED_BYTE, 1, 1));
  EXPECT_FALSE(OSMesaGetDepthBuffer(context.handle, &width, &height, &bytes, &values));
  EXPECT_EQ(width, 0);
  EXPECT_EQ(values, nullptr);
  GLint bits = -1;
  glGetIntegerv(GL_DEPTH_BITS, &bits);
  EXPECT_EQ(bits, 0);
  // Without a depth buffer the test always passes (spec 4.1.5).
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_NEVER);
  glColor3f(1, 1, 1);
  glRectf(-1, -1, 1, 1);
  glFinish();
  EXPECT_EQ(pixel, 0xFFFFFFFFu);
}

// GL 1.x clamps whatever is stored, so that OSMesaColorClamp has nothing left to decide.
TEST(OsmesaColorClamp, FloatBuffersHoldClampedColorsEitherWay) {
  for (const GLboolean clamp : {GLboolean{GL_FALSE}, GLboolean{GL_TRUE}}) {
    const Context context(OSMesaCreateContext(OSMESA_RGBA, nullptr));
    std::vector<float> pixel(4);
    ASSERT_TRUE(OSMesaMakeCurrent(context.handle, pixel.data(), GL_FLOAT, 1, 1));
    OSMesaColorClamp(clamp);
    clear_all(2, 0.25f, -1, 0.5f);
    glFinish();
    EXPECT_EQ(pixel, (std::vector<float>{1, 0.25f, 0, 0.5f}));
    glColor4f(-2, 0.75f, 2.5f, 0.25f);
    glRectf(-1, -1, 1, 1);
    glFinish();
    EXPECT_EQ(pixel, (std::vector<float>{0, 0.75f, 1, 0.25f}));
  }
}

TEST_F(OsmesaTest, ProcAddressesAreThoseOfTheLibrary) {
  EXPECT_EQ(OSMesaGetProcAddress("glBegin"), reinterpret_cast<OSMESAproc>(glBegin));
  EXPECT_EQ(OSMesaGetProcAddress("glViewport"), reinterpret_cast<OSMESAproc>(glViewport));
  EXPECT_EQ(OSMesaGetProcAddress("OSMesaMakeCurrent"), reinterpret_cast<OSMESAproc>(OSMesaMakeCurrent));
  EXPECT_EQ(OSMesaGetProcAddress("glNoSuchThing"), nullptr);
  EXPECT_EQ(OSMesaGetProcAddress(""), nullptr);
  EXPECT_EQ(OSMesaGetProcAddress(nullptr), nullptr);
}

TEST_F(OsmesaTest, OneContextAThread) {
  clear_all(1, 0, 0, 1);
  OSMesaContext seen = context_;
  std::vector<GLubyte> other_buffer(4 * 4 * 4);
  std::thread([&] {
    seen = OSMesaGetCurrentContext();
    const Context other(OSMesaCreateContext(OSMESA_RGBA, nullptr));
    OSMesaMakeCurrent(other.handle, other_buffer.data(), GL_UNSIGNED_BYTE, 4, 4);
    clear_all(0, 1, 0, 1);
    glFinish();
  }).join();
  EXPECT_EQ(seen, nullptr);
  EXPECT_EQ(OSMesaGetCurrentContext(), context_);
  glFinish();
  EXPECT_EQ(buffer_[0], 255);
  EXPECT_EQ(buffer_[1], 0);
  EXPECT_EQ(other_buffer[0], 0);
  EXPECT_EQ(other_buffer[1], 255);
}

TEST_F(OsmesaTest, TwoContextsTakeTurns) {
  const Context other(OSMesaCreateContext(OSMESA_BGRA, context_));
  std::vector<GLubyte> other_buffer(4 * 4 * 4);
  clear_all(0.2f, 0, 0, 1);
  ASSERT_TRUE(OSMesaMakeCurrent(other.handle, other_buffer.data(), GL_UNSIGNED_BYTE, 4, 4));
  EXPECT_EQ(buffer_[0], 51) << "the context that was current is flushed";
  clear_all(0.4f, 0, 0, 1);
  ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kWidth, kHeight));
  EXPECT_EQ(other_buffer[2], 102);
  clear_pixel(0, 0, 1, 1, 1, 1);
  glFinish();
  EXPECT_EQ(buffer_[0], 255);
  EXPECT_EQ(buffer_[4], 51) << "and its picture is still there";
}

GLint integer(GLenum name) {
  GLint value = -1;
  glGetIntegerv(name, &value);
  return value;
}

void draw_square(float z) {
  glBegin(GL_QUADS);
  glVertex3f(-1, -1, z);
  glVertex3f(1, -1, z);
  glVertex3f(1, 1, z);
  glVertex3f(-1, 1, z);
  glEnd();
}

// What is used of a buffer that was not asked for does nothing.
TEST(OsmesaAncillary, BuffersAreThereAsAskedFor) {
  for (const bool asked : {false, true}) {
    const int bits = asked ? 1 : 0;  // as many as we have, or none
    const Context context(OSMesaCreateContextExt(OSMESA_RGBA, bits, bits, bits, nullptr));
    std::vector<GLubyte> pixel(4);
    ASSERT_TRUE(OSMesaMakeCurrent(context.handle, pixel.data(), GL_UNSIGNED_BYTE, 1, 1));
    assert_halfspace();
    EXPECT_EQ(integer(GL_DEPTH_BITS), asked ? 24 : 0);
    EXPECT_EQ(integer(GL_STENCIL_BITS), asked ? 8 : 0);
    for (const int name : {GL_ACCUM_RED_BITS, GL_ACCUM_GREEN_BITS, GL_ACCUM_BLUE_BITS, GL_ACCUM_ALPHA_BITS})
      EXPECT_EQ(integer(GLenum(name)), asked ? 16 : 0);

    glClearStencil(0x1ff);  // the buffer's eight bits of it
    glClear(GL_STENCIL_BUFFER_BIT);
    clear_all(0, 0, 0, 0);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NOTEQUAL, 0xff, 0xff);
    draw_square(0);
    glFinish();
    EXPECT_EQ(int(pixel[0]), asked ? 0 : 255) << "without a stencil buffer the test always passes";
    glStencilFunc(GL_EQUAL, 1000, 0xff);  // clamped to 255
    draw_square(0);
    glFinish();
    EXPECT_EQ(int(pixel[0]), 255);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));

    glDisable(GL_STENCIL_TEST);
    clear_all(0.2f, 0.4f, 0.6f, 0.8f);
    glAccum(GL_LOAD, 0.5f);
    EXPECT_EQ(glGetError(), GLenum(asked ? GL_NO_ERROR : GL_INVALID_OPERATION));
    if (!asked) continue;
    glAccum(GL_ACCUM, 0.3f);
    glClear(GL_COLOR_BUFFER_BIT);
    glAccum(GL_RETURN, 1);
    glFinish();
    EXPECT_EQ(pixel, (std::vector<GLubyte>{41, 82, 122, 163}));  // 0.8 of 51, 102, 153, 204
  }
}

}  // namespace
}  // namespace halfspace::test
