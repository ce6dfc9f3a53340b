#include "tests/support/scenes.h"

#include <cstdio>
#include <functional>

#include "tests/support/random.h"
#include "tests/support/textures.h"

namespace halfspace::test {

using namespace raster;

namespace {

// Makes the draws of one scene.
class SceneMaker {
 public:
  SceneMaker(uint64_t seed, int size) : random_(seed), size_(size) {}

  Random& random() { return random_; }

  DrawState state(bool depth = true) {
    DrawState s = plain_state(size_, size_);
    s.depth.test = depth;
    return s;
  }

  // w in [w_low, w_high]; x / w and y / w in [-reach, reach].
  Vertex vertex(float w_low, float w_high, float reach = 1.2f) {
    Vertex v;
    v.w = w_low == w_high ? w_low : random_.real(w_low, w_high);
    v.x = v.w * random_.real(-reach, reach);
    v.y = v.w * random_.real(-reach, reach);
    v.z = v.w * random_.real(-0.98f, 0.98f);
    v.color = color();
    v.s = random_.real(-4, 4);
    v.t = random_.real(-4, 4);
    return v;
  }

  std::vector<Vertex> vertices(int count, float w_low, float w_high, float reach = 1.2f) {
    std::vector<Vertex> list;
    for (int i = 0; i < count; ++i) list.push_back(vertex(w_low, w_high, reach));
    return list;
  }

  Color color() {
    const float r = random_.real(0, 1), g = random_.real(0, 1), b = random_.real(0, 1);
    return {r, g, b, random_.real(0, 1)};
  }

  // Filter and wrap at random; in braces, because they are evaluated in order.
  Sampler any_sampler() {
    const int64_t pick[2] = {random_.integer(0, 1), random_.integer(0, 2)};
    return sampler_of(Filter(pick[0]), Wrap(pick[1]));
  }

  template <typename Enum>
  Enum any(int count) {
    return Enum(random_.integer(0, count - 1));
  }

  std::shared_ptr<const TextureView> noise(BaseFormat format, int width, int height, const Sampler& sampler,
                                           int border = 0) {
    TestTexture texture(format);
    texture.add_noise(random_, width, height, border);
    if (sampler.mip != MipMode::none && border == 0) {
      while (width > 1 || height > 1) {
        width = width > 1 ? width / 2 : 1;
        height = height > 1 ? height / 2 : 1;
        texture.add_noise(random_, width, height);
      }
    }
    return texture.view(sampler);
  }

 private:
  Random random_;
  int size_;
};

void flat_colors(SceneMaker& m, Scene& scene) {
  for (int i = 0; i < 20; ++i) {
    SceneDraw draw{m.state(), Primitive::triangles, m.vertices(3, 1, 1), {}};
    draw.vertices[1].color = draw.vertices[2].color = draw.vertices[0].color;
    scene.draws.push_back(draw);
  }
}

void smooth_colors(SceneMaker& m, Scene& scene) {
  scene.draws.push_back({m.state(), Primitive::triangles, m.vertices(90, 0.5f, 9), {}});
}

void textured(SceneMaker& m, Scene& scene) {
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::clamp_to_edge}) {
      for (float far_w : {1.0f, 6.0f}) {
        SceneDraw draw{m.state(), Primitive::triangles, m.vertices(12, 1, far_w), {}};
        Sampler sampler = sampler_of(filter, wrap);
        sampler.border_color = m.color();
        draw.state.texture.view = m.noise(BaseFormat::rgba, 32, 16, sampler);
        scene.draws.push_back(draw);
      }
    }
  }
}

void odd_textures(SceneMaker& m, Scene& scene) {
  const int sizes[][2] = {{1, 1}, {3, 5}, {7, 1}, {255, 6}, {100, 33}};
  for (const auto& size : sizes) {
    SceneDraw draw{m.state(), Primitive::triangles, m.vertices(12, 1, 4), {}};
    draw.state.texture.view = m.noise(BaseFormat::rgb, size[0], size[1], m.any_sampler());
    scene.draws.push_back(draw);
  }
}

void mipmaps(SceneMaker& m, Scene& scene) {
  for (Filter filter : {Filter::nearest, Filter::linear}) {
    for (MipMode mip : {MipMode::nearest, MipMode::linear}) {
      SceneDraw draw{m.state(), Primitive::triangles, m.vertices(18, 1, 20), {}};
      draw.state.texture.view = m.noise(BaseFormat::rgba, 64, 32, sampler_of(filter, Wrap::repeat, mip));
      scene.draws.push_back(draw);
    }
  }
}

void environments(SceneMaker& m, Scene& scene) {
  for (int format = 0; format < 6; ++format) {
    for (int env = 0; env < 4; ++env) {
      SceneDraw draw{m.state(false), Primitive::triangles, m.vertices(3, 1, 3), {}};
      draw.state.texture.view = m.noise(BaseFormat(format), 8, 8, sampler_of(Filter::linear, Wrap::repeat));
      draw.state.texture.env = EnvMode(env);
      draw.state.texture.env_color = m.color();
      scene.draws.push_back(draw);
    }
  }
}

void borders_matrices_projection(SceneMaker& m, Scene& scene) {
  for (int i = 0; i < 10; ++i) {
    SceneDraw draw{m.state(), Primitive::triangles, m.vertices(6, 1, 4), {}};
    draw.state.texture.view = m.noise(BaseFormat::rgba, 16, 8, m.any_sampler(), i % 2);
    if (i % 3) {
      for (double& e : draw.state.texture.matrix)
        e += double(m.random().real(-0.5f, 0.5f)) * (i % 3 == 1 ? 1 : 0.1);
      draw.state.texture.matrix[15] = 4;
      draw.state.texture.matrix_is_identity = false;
    }
    if (i % 2) {
      for (Vertex& v : draw.vertices) v.q = m.random().real(1, 3);
    }
    scene.draws.push_back(draw);
  }
}

void blending(SceneMaker& m, Scene& scene) {
  for (int i = 0; i < 60; ++i) {
    SceneDraw draw{m.state(false), Primitive::triangles, m.vertices(3, 1, 2), {}};
    draw.state.blend = {true, m.any<BlendFactor>(11), m.any<BlendFactor>(11)};
    draw.state.alpha_test = {m.random().integer(0, 2) == 0, m.any<CompareFunc>(8), m.random().real(0, 1)};
    if (i % 5 == 0) {
      draw.state.texture.view =
          m.noise(BaseFormat::luminance_alpha, 16, 16, sampler_of(Filter::linear, Wrap::repeat));
    }
    scene.draws.push_back(draw);
  }
}

void fragment_state(SceneMaker& m, Scene& scene) {
  for (int i = 0; i < 60; ++i) {
    SceneDraw draw{m.state(), Primitive::triangles, m.vertices(3, 1, 3), {}};
    Random& r = m.random();
    draw.state.depth = {r.integer(0, 4) != 0, m.any<CompareFunc>(8), r.integer(0, 1) == 1};
    draw.state.color_mask = {r.integer(0, 3) != 0, r.integer(0, 3) != 0, r.integer(0, 3) != 0,
                             r.integer(0, 3) != 0};
    draw.state.raster.scissor_test = r.integer(0, 1) == 1;
    draw.state.raster.scissor = {int(r.integer(-9, 50)), int(r.integer(-9, 50)), int(r.integer(50, 140)),
                                 int(r.integer(50, 140))};
    if (i % 4 == 0) std::swap(draw.state.viewport.depth_near, draw.state.viewport.depth_far);
    if (i % 4 == 1) draw.state.viewport.depth_near = 0.25, draw.state.viewport.depth_far = 0.5;
    draw.state.raster.cull_back = i % 6 == 1;
    draw.state.raster.cull_front = i % 6 == 2;
    draw.state.raster.front_is_ccw = i % 12 < 6;
    scene.draws.push_back(draw);
  }
}

void all_primitives(SceneMaker& m, Scene& scene) {
  for (int primitive = 0; primitive < 10; ++primitive) {
    for (bool flat : {false, true}) {
      SceneDraw draw{m.state(), Primitive(primitive), m.vertices(13, 1, 3), {}};
      draw.state.raster.flat_shading = flat;
      if (primitive % 2) {
        for (int i = 0; i < 17; ++i) draw.indices.push_back(uint32_t(m.random().integer(0, 12)));
      }
      if (primitive % 3 == 0) {
        draw.state.texture.view = m.noise(BaseFormat::rgba, 16, 16, sampler_of(Filter::linear, Wrap::repeat));
      }
      scene.draws.push_back(draw);
    }
  }
}

void lines_and_points(SceneMaker& m, Scene& scene) {
  scene.draws.push_back({m.state(), Primitive::lines, m.vertices(120, 1, 4), {}});
  scene.draws.push_back({m.state(), Primitive::points, m.vertices(400, 1, 4), {}});
}

// Vertices on both sides of the eye.
void behind_the_eye(SceneMaker& m, Scene& scene) {
  for (int i = 0; i < 30; ++i) {
    SceneDraw draw{
        m.state(), i % 10 == 9 ? Primitive::lines : Primitive::triangles, m.vertices(6, 0.5f, 5), {}};
    for (Vertex& v : draw.vertices) {
      if (m.random().integer(0, 2) == 0) v.w = m.random().real(-2, 0.2f);
      v.z = m.random().real(-4, 4);
    }
    if (i % 2) {
      draw.state.texture.view = m.noise(BaseFormat::rgba, 16, 16, sampler_of(Filter::linear, Wrap::repeat));
    }
    scene.draws.push_back(draw);
  }
}

void small_triangles(SceneMaker& m, Scene& scene) {
  SceneDraw draw{m.state(), Primitive::triangles, {}, {}};
  for (int i = 0; i < 6000; ++i) {
    const Vertex center = m.vertex(1, 3);
    for (int k = 0; k < 3; ++k) {
      Vertex v = center;
      v.x += center.w * m.random().real(-0.03f, 0.03f);
      v.y += center.w * m.random().real(-0.03f, 0.03f);
      v.color = m.color();
      draw.vertices.push_back(v);
    }
  }
  scene.draws.push_back(draw);
}

// Triangles of a few pixels with everything a fragment can ask for, so that many of them share what is shaded
// at once.
void small_mixed_triangles(SceneMaker& m, Scene& scene) {
  for (int variant = 0; variant < 12; ++variant) {
    SceneDraw draw{m.state(), Primitive::triangles, {}, {}};
    draw.state.raster.flat_shading = variant % 3 == 1;
    draw.state.depth.test = variant % 4 != 3;
    if (variant % 2) draw.state.texture.view = m.noise(BaseFormat::rgba, 16, 16, m.any_sampler());
    if (variant % 4 == 2) draw.state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
    if (variant % 5 == 4) draw.state.alpha_test = {true, CompareFunc::greater, 0.5f};
    for (int i = 0; i < 700; ++i) {
      const Vertex center = m.vertex(1, variant < 6 ? 1.0f : 3.0f);
      const Color color = m.color();
      for (int k = 0; k < 3; ++k) {
        Vertex v = center;
        v.x += center.w * m.random().real(-0.04f, 0.04f);
        v.y += center.w * m.random().real(-0.04f, 0.04f);
        // Constant colours, and varying ones.
        v.color = variant % 3 == 2 ? color : m.color();
        v.s = m.random().real(-2, 2);
        v.t = m.random().real(-2, 2);
        draw.vertices.push_back(v);
      }
    }
    scene.draws.push_back(draw);
  }
}

// Every level of all axes and of each alone, on whatever an axis may touch.
void accuracies(SceneMaker& m, Scene& scene) {
  std::vector<Accuracy> settings;
  for (Level level : {Level::draft, Level::standard, Level::exact}) {
    settings.push_back(Accuracy::all(level));
    for (const AccuracyAxis& axis : kAccuracyAxes) {
      settings.push_back({});
      settings.back().*axis.level = level;
      settings.push_back(Accuracy::all(level == Level::draft ? Level::exact : Level::draft));
      settings.back().*axis.level = level;
    }
  }
  for (size_t i = 0; i < settings.size(); ++i) {
    for (Filter filter : {Filter::nearest, Filter::linear}) {
      // Large and small, in perspective and not.
      const int count = i % 4 == 3 ? 300 : 6;
      SceneDraw draw{m.state(), Primitive::triangles, m.vertices(count, 1, i % 5 == 4 ? 1.0f : 20.0f), {}};
      if (count > 6) {
        for (size_t k = 0; k + 2 < draw.vertices.size(); k += 3) {
          for (size_t n = 1; n < 3; ++n) {
            Vertex& v = draw.vertices[k + n];
            const Vertex& first = draw.vertices[k];
            v.w = first.w;
            v.x = first.x + first.w * m.random().real(-0.05f, 0.05f);
            v.y = first.y + first.w * m.random().real(-0.05f, 0.05f);
            v.z = first.z;
          }
        }
      }
      DrawState& state = draw.state;
      state.accuracy = settings[i];
      state.depth.test = i % 3 != 0;
      state.raster.flat_shading = i % 7 == 6;
      if (i % 3 == 1) state.fog = {true, FogMode(i % 9 / 3), {0.1f, 0.6f, 0.9f, 0}, 0.05f, 1, 30};
      if (i % 4 == 1) state.blend = {true, BlendFactor::src_alpha, BlendFactor::one_minus_src_alpha};
      if (i % 5 == 2) state.alpha_test = {true, CompareFunc::greater, 0.3f};
      state.polygon.smooth = i % 6 == 5;
      const MipMode mip = i % 2 == 0 ? MipMode::linear : (i % 4 == 1 ? MipMode::none : MipMode::nearest);
      if (i % 8 != 7) {
        state.texture.view = m.noise(i % 6 == 2 ? BaseFormat::intensity : BaseFormat::rgba, i % 2 ? 32 : 20,
                                     32, sampler_of(filter, Wrap(i % 3), mip));
        state.texture.env = EnvMode(i % 4);
        state.texture.env_color = m.color();
        if (i % 5 == 0) {
          for (Vertex& v : draw.vertices) v.q = m.random().real(0.5f, 2);
        }
      }
      scene.draws.push_back(std::move(draw));
    }
  }
}

// A plane that runs almost to the horizon: the double path.
void horizon(SceneMaker& m, Scene& scene) {
  for (float far_w : {1e3f, 1e6f}) {
    SceneDraw draw{m.state(), Primitive::quads, {}, {}};
    for (int i = 0; i < 4; ++i) {
      Vertex v;
      v.w = i < 2 ? 0.3f : far_w;
      v.x = (i == 0 || i == 3 ? -2 : 2) * v.w;
      v.y = i < 2 ? -1 : -0.01f * v.w;
      v.z = i < 2 ? -v.w : v.w * 0.999f;
      v.s = (i == 0 || i == 3 ? -1.0f : 1.0f) * v.w;
      v.t = v.w;
      v.color = m.color();
      draw.vertices.push_back(v);
    }
    draw.state.texture.view =
        m.noise(BaseFormat::rgba, 64, 64, sampler_of(Filter::linear, Wrap::repeat, MipMode::linear));
    scene.draws.push_back(draw);
  }
}

// A model seen through a matrix, indexed.
void matrices(SceneMaker& m, Scene& scene) {
  SceneDraw draw{m.state(), Primitive::triangles, m.vertices(30, 1, 1, 2), {}};
  // Frustum 45 degrees, near 0.5, far 50, after a turn and a step back.
  const double c = 0.8, s = 0.6, f = 2.414, a = -50.5 / 49.5, b = -50 / 49.5;
  draw.state.clip_from_object = {f * c, 0, -s * a, s, 0, f, 0, 0, f * s, 0, c * a, -c, 0, 0, -6 * a + b, 6};
  for (int i = 0; i < 150; ++i) draw.indices.push_back(uint32_t(m.random().integer(0, 29)));
  scene.draws.push_back(draw);
}

// Corners up to 10^5 px away, some cut by the near plane as well.
void far_corners(SceneMaker& m, Scene& scene) {
  for (int i = 0; i < 24; ++i) {
    SceneDraw draw{m.state(), Primitive::triangles, m.vertices(3, 1, 4, i % 2 ? 1200.0f : 300.0f), {}};
    if (i % 3) draw.vertices[1] = m.vertex(1, 4, 0.8f);
    if (i % 3 == 2) draw.vertices[2].w = -draw.vertices[2].w;
    if (i % 4 == 3) {
      draw.state.texture.view = m.noise(BaseFormat::rgba, 16, 16, sampler_of(Filter::linear, Wrap::repeat));
    }
    scene.draws.push_back(draw);
  }
}

using Maker = void (*)(SceneMaker&, Scene&);

std::vector<Scene> make(int size, uint64_t seed, const std::vector<std::pair<const char*, Maker>>& makers) {
  std::vector<Scene> list;
  for (const auto& [name, maker] : makers) {
    SceneMaker m(seed++, size);
    Scene scene;
    scene.name = name;
    maker(m, scene);
    list.push_back(std::move(scene));
  }
  return list;
}

}  // namespace

std::vector<Scene> scenes(int size) {
  return make(size, 1000,
              {{"flat_colors", flat_colors},
               {"smooth_colors", smooth_colors},
               {"textured", textured},
               {"odd_textures", odd_textures},
               {"mipmaps", mipmaps},
               {"environments", environments},
               {"borders_matrices_projection", borders_matrices_projection},
               {"blending", blending},
               {"fragment_state", fragment_state},
               {"all_primitives", all_primitives},
               {"lines_and_points", lines_and_points},
               {"behind_the_eye", behind_the_eye},
               {"small_triangles", small_triangles},
               {"accuracies", accuracies},
               {"horizon", horizon},
               {"matrices", matrices},
               {"small_mixed_triangles", small_mixed_triangles}});
}

std::vector<Scene> far_scenes(int size) { return make(size, 2000, {{"far_corners", far_corners}}); }

void draw_scene(Canvas& canvas, const Scene& scene, int x, int y) {
  for (const SceneDraw& draw : scene.draws) {
    DrawState state = draw.state;
    state.viewport.x += x;
    state.viewport.y += y;
    Rect& scissor = state.raster.scissor;
    scissor = {scissor.x0 + x, scissor.y0 + y, scissor.x1 + x, scissor.y1 + y};
    canvas.draw(state, draw.primitive, draw.vertices, draw.indices);
  }
}

std::map<std::string, std::string> scene_hashes(int threads) {
  constexpr int kSize = 200;
  std::vector<Scene> all = scenes(kSize);
  for (Scene& scene : far_scenes(kSize)) all.push_back(std::move(scene));
  std::map<std::string, std::string> hashes;
  for (const Scene& scene : all) {
    Canvas canvas(kSize, kSize, threads);
    draw_scene(canvas, scene);
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash(canvas.read())));
    hashes[scene.name] = text;
  }
  return hashes;
}

}  // namespace halfspace::test
