// The same geometry through Begin/End, client arrays, indices, ArrayElement and display lists: the same
// bytes.
#include <GL/osmesa.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "osmesa_context.h"

namespace halfspace::test {
namespace {

constexpr int kSize = 96;
constexpr int kVertices = 48;

struct Vertex {
  GLfloat tex_coord[2];
  GLfloat color[4];
  GLfloat normal[3];
  GLfloat position[3];
};

std::vector<Vertex> random_vertices(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-1.2f, 1.2f), unit(0, 1);
  std::vector<Vertex> vertices(kVertices);
  for (Vertex& v : vertices) {
    for (float& t : v.tex_coord) t = 3 * number(random);
    for (float& c : v.color) c = unit(random);
    for (float& n : v.normal) n = number(random);
    for (float& p : v.position) p = number(random);
  }
  // Some stand twice, as the corners of a mesh do.
  for (size_t i = 0; i < kVertices; i += 3) vertices[i] = vertices[(i * 7 + 5) % kVertices];
  return vertices;
}

class GeometryPaths : public ::testing::Test {
 protected:
  void SetUp() override {
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
    ASSERT_NE(context_, nullptr);
    buffer_.assign(kSize * kSize * 4, 0);
    ASSERT_TRUE(OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSize, kSize));
    assert_halfspace();
    const GLubyte texels[16] = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 64, 255, 255, 0, 32};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glClearColor(0.1f, 0.2f, 0.3f, 1);
    glRotatef(20, 1, 2, 3);
    glInterleavedArrays(GL_V3F, sizeof(Vertex), nullptr);  // each test enables what it needs
  }
  void TearDown() override { OSMesaDestroyContext(context_); }

  std::vector<GLubyte> picture(const std::function<void()>& draw) {
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw();
    glFinish();
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    return buffer_;
  }

  OSMesaContext context_ = nullptr;
  std::vector<GLubyte> buffer_;
};

void immediately(GLenum mode, const std::vector<Vertex>& vertices) {
  glBegin(mode);
  for (const Vertex& v : vertices) {
    glTexCoord2fv(v.tex_coord);
    glColor4fv(v.color);
    glNormal3fv(v.normal);
    glVertex3fv(v.position);
  }
  glEnd();
}

void use_arrays(const std::vector<Vertex>& vertices) {
  glTexCoordPointer(2, GL_FLOAT, sizeof(Vertex), vertices[0].tex_coord);
  glColorPointer(4, GL_FLOAT, sizeof(Vertex), vertices[0].color);
  glNormalPointer(GL_FLOAT, sizeof(Vertex), vertices[0].normal);
  glVertexPointer(3, GL_FLOAT, sizeof(Vertex), vertices[0].position);
  for (GLenum array : std::initializer_list<GLenum>{GL_VERTEX_ARRAY, GL_COLOR_ARRAY, GL_NORMAL_ARRAY,
                                                    GL_TEXTURE_COORD_ARRAY})
    glEnableClientState(array);
}

void element_by_element(GLenum mode) {
  glBegin(mode);
  for (GLint i = 0; i < kVertices; ++i) glArrayElement(i);
  glEnd();
}

void by_list(GLenum list_mode, const std::function<void()>& draw) {
  glNewList(1, list_mode);
  draw();
  glEndList();
  if (list_mode == GL_COMPILE) glCallList(1);
}

struct Setting {
  const char* name;
  std::vector<GLenum> enabled;
  GLenum shading;
};

const std::vector<Setting> kSettings = {
    {"flat", {}, GL_FLAT},
    {"smooth", {GL_DEPTH_TEST}, GL_SMOOTH},
    {"textured", {GL_TEXTURE_2D, GL_BLEND}, GL_SMOOTH},
    {"lit", {GL_LIGHTING, GL_LIGHT0, GL_DEPTH_TEST}, GL_SMOOTH},
    {"lit, with the vertices' colours", {GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_TEXTURE_2D}, GL_FLAT},
};

TEST_F(GeometryPaths, DrawTheSameBytes) {
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  std::vector<GLuint> indices(kVertices);
  for (size_t i = 0; i < kVertices; ++i) indices[i] = GLuint(i);
  for (const Setting& setting : kSettings) {
    for (GLenum cap : setting.enabled) glEnable(cap);
    glShadeModel(setting.shading);
    for (GLenum mode = GL_POINTS; mode <= GL_POLYGON; ++mode) {
      SCOPED_TRACE(std::string(setting.name) + ", mode " + std::to_string(mode));
      const std::vector<Vertex> vertices = random_vertices(mode + 1);
      use_arrays(vertices);
      const std::vector<std::pair<const char*, std::function<void()>>> paths = {
          {"Begin/End", [&] { immediately(mode, vertices); }},
          {"DrawArrays", [&] { glDrawArrays(mode, 0, kVertices); }},
          {"DrawElements", [&] { glDrawElements(mode, kVertices, GL_UNSIGNED_INT, indices.data()); }},
          {"ArrayElement", [&] { element_by_element(mode); }},
      };
      const std::vector<GLubyte> expected = picture(paths[0].second);
      EXPECT_NE(expected, picture([] {}));
      for (const auto& [name, draw] : paths) {
        EXPECT_TRUE(picture(draw) == expected) << name;
        EXPECT_TRUE(picture([&, d = draw] { by_list(GL_COMPILE, d); }) == expected) << name << " in a list";
        EXPECT_TRUE(picture([&, d = draw] { by_list(GL_COMPILE_AND_EXECUTE, d); }) == expected)
            << name << ", compiled and executed";
        EXPECT_TRUE(picture([] { glCallList(1); }) == expected) << name << ", afterwards";
      }
    }
    for (GLenum cap : setting.enabled) glDisable(cap);
  }
}

}  // namespace
}  // namespace halfspace::test
