#include "ref_app/effects.h"

#include <GL/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <stdexcept>

#include "ref_app/noise.h"
#include "ref_app/textures.h"

namespace ref_app {
namespace {

struct Named {
  const char* name;
  const char* description;
};

// In the order of Effect.
constexpr Named kEffects[] = {
    {"flat", "the primitives, each object in one colour"},
    {"smooth", "a colour a vertex"},
    {"depth", "depth test and writes"},
    {"texture", "the nearest texel, modulated by the colour"},
    {"perspective", "texture and colour perspective-correct"},
    {"filter", "linear between texels"},
    {"mipmap", "linear between levels of detail"},
    {"light", "two lights with highlights"},
    {"fog", "fog by the square of the distance"},
    {"blend", "source over destination"},
    {"stencil", "counts the fragments of each pixel"},
    {"alpha_test", "alpha test, passed everywhere"},
};
constexpr const char* kEverything = "everything";
constexpr const char* kIdle = "idle";

Effect effect_of(const std::string& name) {
  if (name == kEverything) return Effect::alpha_test;
  if (name == kIdle) return Effect::flat;
  for (size_t i = 0; i < std::size(kEffects); ++i) {
    if (name == kEffects[i].name) return static_cast<Effect>(i);
  }
  throw std::out_of_range("there is no effect " + name);
}

// In eye coordinates: the viewer is at the origin and looks along -z.
struct EffectVertex {
  glm::vec4 position;
  glm::vec4 flat;  // the same position after the projection and the division by w
  glm::vec3 normal;
  glm::vec4 color;
  glm::vec2 tex_coord;
};

struct Mesh {
  glm::vec4 color;  // of the whole object
  std::vector<EffectVertex> vertices;
  std::vector<uint32_t> indices;
};

// (u, v) in [0, 1]^2 to a vertex, on a grid of columns by rows quads; rows are drawn in turn.
template <typename VertexOf>
Mesh make_grid(int columns, int rows, const glm::vec4& color, VertexOf vertex_of) {
  Mesh mesh{color, {}, {}};
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.vertices.push_back(vertex_of(static_cast<float>(i) / static_cast<float>(columns),
                                        static_cast<float>(j) / static_cast<float>(rows)));
    }
  }
  const auto at = [columns](int i, int j) { return static_cast<uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      for (const uint32_t index :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        mesh.indices.push_back(index);
    }
  }
  return mesh;
}

float pi() { return glm::pi<float>(); }

// Hills, from far to near, so that they look right without a depth buffer, too; from right to left, so that
// their upper side is the front.
Mesh make_floor() {
  constexpr float kFar = -48, kNear = -2.2F, kHalfWidth = 26;
  return make_grid(48, 48, {0.55F, 0.65F, 0.4F, 1}, [](float u, float v) {
    const float x = glm::mix(kHalfWidth, -kHalfWidth, u), z = glm::mix(kFar, kNear, v);
    const float y = -1.4F + 0.3F * std::sin(0.9F * x) * std::cos(0.7F * z);
    const glm::vec3 normal(-0.27F * std::cos(0.9F * x) * std::cos(0.7F * z), 1,
                           0.21F * std::sin(0.9F * x) * std::sin(0.7F * z));
    const glm::vec4 color(0.45F + 0.3F * u, 0.75F - 0.2F * v, 0.35F + 0.1F * u * v, 1);
    return EffectVertex{{x, y, z, 1}, {}, glm::normalize(normal), color, {0.5F * x, 0.5F * z}};
  });
}

Mesh make_sphere(const glm::vec3& center, float radius, const glm::vec4& color) {
  return make_grid(28, 16, color, [&](float u, float v) {
    const float around = 2 * pi() * u, down = pi() * v;
    // Anticlockwise from outside, for a grid whose rows run downwards.
    const glm::vec3 normal(std::sin(down) * std::cos(around), -std::cos(down),
                           -std::sin(down) * std::sin(around));
    const glm::vec4 shade(glm::vec3(color) * (0.6F + 0.4F * v), color.a);
    return EffectVertex{glm::vec4(center + radius * normal, 1), {}, normal, shade, {3 * u, 1.5F * v}};
  });
}

std::vector<Mesh> make_meshes() {
  std::vector<Mesh> meshes{make_floor()};
  for (const float z : {-15.0F, -10.0F, -6.0F}) {
    for (const float x : {-2.2F, 0.0F, 2.2F}) {
      const glm::vec4 color(0.5F + 0.2F * x, 0.4F, 0.9F + 0.04F * z, 0.7F);
      meshes.push_back(make_sphere({x * (1 - 0.03F * z), -0.1F, z}, 1, color));
    }
  }
  return meshes;
}

// Alpha is nowhere below a half.
Image make_effect_image() {
  Image image = make_marble();
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float alpha = fractal_noise(static_cast<float>(x) / 32, static_cast<float>(y) / 32, 8, 2, 5);
      const size_t texel = static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x);
      image.rgba[4 * texel + 3] = static_cast<uint8_t>(128 + std::lround(127 * alpha));
    }
  }
  return image;
}

// Each texel the mean of four.
Image half_size(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  const auto row = static_cast<size_t>(image.width) * 4;
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const uint8_t* corner = &image.rgba[static_cast<size_t>(2 * y) * row + static_cast<size_t>(2 * x) * 4];
      for (size_t c = 0; c < 4; ++c) {
        const int sum = corner[c] + corner[c + 4] + corner[c + row] + corner[c + row + 4];
        half.rgba.push_back(static_cast<uint8_t>((sum + 2) / 4));
      }
    }
  }
  return half;
}

void set_enabled(GLenum capability, bool enabled) {
  if (enabled) {
    glEnable(capability);
  } else {
    glDisable(capability);
  }
}

void set_light(GLenum light, const glm::vec4& position, const glm::vec4& color) {
  glLightfv(light, GL_POSITION, glm::value_ptr(position));
  glLightfv(light, GL_DIFFUSE, glm::value_ptr(color));
  glLightfv(light, GL_SPECULAR, glm::value_ptr(color));
  glEnable(light);
}

class EffectScene final : public Scene {
 public:
  // `set_up`: whether the values behind the effects are given; switching them on is another matter.
  EffectScene(Effect last, bool set_up) : last_(last), meshes_(make_meshes()) {
    if (!set_up) return;
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    set_up_texture();
    set_up_light();
    const glm::vec4 fog(0.62F, 0.72F, 0.85F, 1);
    glFogi(GL_FOG_MODE, GL_EXP2);
    glFogf(GL_FOG_DENSITY, 0.035F);
    glFogfv(GL_FOG_COLOR, glm::value_ptr(fog));
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glStencilFunc(GL_ALWAYS, 0, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    glAlphaFunc(GL_GREATER, 0.1F);
  }
  ~EffectScene() override {
    if (texture_) glDeleteTextures(1, &texture_);
  }
  EffectScene(const EffectScene&) = delete;
  EffectScene& operator=(const EffectScene&) = delete;

  void draw(Renderer& renderer, const Motion&) override {
    glViewport(0, 0, renderer.width(), renderer.height());
    const float aspect = static_cast<float>(renderer.width()) / static_cast<float>(renderer.height());
    if (aspect != aspect_) project(aspect);
    set_state();
    glClearColor(0.62F, 0.72F, 0.85F, 1);
    glClear(GL_COLOR_BUFFER_BIT | (on(Effect::depth) ? GL_DEPTH_BUFFER_BIT : 0u) |
            (on(Effect::stencil) ? GL_STENCIL_BUFFER_BIT : 0u));
    for (const Mesh& mesh : meshes_) draw(mesh);
    glFinish();
  }

  size_t triangle_count() const override {
    size_t count = 0;
    for (const Mesh& mesh : meshes_) count += mesh.indices.size() / 3;
    return count;
  }

 private:
  bool on(Effect effect) const { return last_ >= effect; }

  void set_up_texture() {
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    int level = 0;
    for (Image image = make_effect_image(); image.width >= 1; image = half_size(image), ++level) {
      glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   image.rgba.data());
    }
    const GLint minify = on(Effect::mipmap)   ? GL_LINEAR_MIPMAP_LINEAR
                         : on(Effect::filter) ? GL_LINEAR
                                              : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, on(Effect::filter) ? GL_LINEAR : GL_NEAREST);
  }

  static void set_up_light() {
    set_light(GL_LIGHT0, {0.5F, 1, 0.6F, 0}, {0.9F, 0.9F, 0.8F, 1});
    set_light(GL_LIGHT1, {-3, 4, -4, 1}, {0.35F, 0.35F, 0.5F, 1});
    const glm::vec4 highlight(0.6F, 0.6F, 0.6F, 1);
    glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, glm::value_ptr(highlight));
    glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 30);
    glColorMaterial(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE);
  }

  // Where the vertices lie in the window does not depend on whether GL divides by w or we do.
  void project(float aspect) {
    aspect_ = aspect;
    projection_ = glm::perspective(glm::radians(50.0F), aspect, 1.0F, 60.0F);
    for (Mesh& mesh : meshes_) {
      for (EffectVertex& vertex : mesh.vertices) {
        const glm::vec4 clip = projection_ * vertex.position;
        vertex.flat = glm::vec4(glm::vec3(clip) / clip.w, 1);
      }
    }
  }

  void set_state() const {
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixf(glm::value_ptr(on(Effect::perspective) ? projection_ : glm::mat4(1)));
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glShadeModel(on(Effect::smooth) ? GL_SMOOTH : GL_FLAT);
    glEnable(GL_CULL_FACE);
    set_enabled(GL_DEPTH_TEST, on(Effect::depth));
    set_enabled(GL_TEXTURE_2D, on(Effect::texture));
    set_enabled(GL_LIGHTING, on(Effect::light));
    set_enabled(GL_COLOR_MATERIAL, on(Effect::light));
    set_enabled(GL_FOG, on(Effect::fog));
    set_enabled(GL_BLEND, on(Effect::blend));
    set_enabled(GL_STENCIL_TEST, on(Effect::stencil));
    set_enabled(GL_ALPHA_TEST, on(Effect::alpha_test));
  }

  void draw(const Mesh& mesh) const {
    constexpr GLsizei kStride = sizeof(EffectVertex);
    const EffectVertex& first = mesh.vertices.front();
    glVertexPointer(4, GL_FLOAT, kStride, on(Effect::perspective) ? &first.position : &first.flat);
    glEnableClientState(GL_VERTEX_ARRAY);
    glColorPointer(4, GL_FLOAT, kStride, &first.color);
    set_array(GL_COLOR_ARRAY, on(Effect::smooth));
    glTexCoordPointer(2, GL_FLOAT, kStride, &first.tex_coord);
    set_array(GL_TEXTURE_COORD_ARRAY, on(Effect::texture));
    glNormalPointer(GL_FLOAT, kStride, &first.normal);
    set_array(GL_NORMAL_ARRAY, on(Effect::light));
    glColor4fv(glm::value_ptr(mesh.color));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh.indices.size()), GL_UNSIGNED_INT,
                   mesh.indices.data());
  }

  static void set_array(GLenum array, bool enabled) {
    if (enabled) {
      glEnableClientState(array);
    } else {
      glDisableClientState(array);
    }
  }

  Effect last_;
  std::vector<Mesh> meshes_;
  glm::mat4 projection_{1};
  float aspect_ = 0;
  GLuint texture_ = 0;
};

}  // namespace

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const Named& effect : kEffects) names.push_back(effect.name);
  names.push_back(kEverything);
  names.push_back(kIdle);
  return names;
}

const char* effect_description(const std::string& name) {
  if (name == kEverything) return "all of these";
  if (name == kIdle) return "none of these, each set up and switched off";
  return kEffects[static_cast<size_t>(effect_of(name))].description;
}

std::unique_ptr<Scene> make_effect_scene(const std::string& name) {
  const Effect last = effect_of(name);
  return std::make_unique<EffectScene>(last, name == kIdle || last != Effect::flat);
}

}  // namespace ref_app
