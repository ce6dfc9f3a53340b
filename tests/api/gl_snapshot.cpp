#include "tests/api/gl_snapshot.h"

#include <GL/glext.h>

#include <cstdint>
#include <initializer_list>
#include <sstream>

namespace halfspace::test {
namespace {

struct Query {
  const char* text;
  GLenum name;
  int values;
};

#define QUERY(name, values) \
  { #name, name, values }

constexpr Query kLightQueries[] = {
    QUERY(GL_AMBIENT, 4),
    QUERY(GL_DIFFUSE, 4),
    QUERY(GL_SPECULAR, 4),
    QUERY(GL_POSITION, 4),
    QUERY(GL_SPOT_DIRECTION, 3),
    QUERY(GL_SPOT_EXPONENT, 1),
    QUERY(GL_SPOT_CUTOFF, 1),
    QUERY(GL_CONSTANT_ATTENUATION, 1),
    QUERY(GL_LINEAR_ATTENUATION, 1),
    QUERY(GL_QUADRATIC_ATTENUATION, 1),
};
constexpr Query kMaterialQueries[] = {
    QUERY(GL_AMBIENT, 4),  QUERY(GL_DIFFUSE, 4),   QUERY(GL_SPECULAR, 4),
    QUERY(GL_EMISSION, 4), QUERY(GL_SHININESS, 1), QUERY(GL_COLOR_INDEXES, 3),
};
constexpr Query kTexParameterQueries[] = {
    QUERY(GL_TEXTURE_MIN_FILTER, 1), QUERY(GL_TEXTURE_MAG_FILTER, 1),   QUERY(GL_TEXTURE_WRAP_S, 1),
    QUERY(GL_TEXTURE_WRAP_T, 1),     QUERY(GL_TEXTURE_BORDER_COLOR, 4), QUERY(GL_TEXTURE_PRIORITY, 1),
};
constexpr Query kTexLevelQueries[] = {
    QUERY(GL_TEXTURE_WIDTH, 1),
    QUERY(GL_TEXTURE_HEIGHT, 1),
    QUERY(GL_TEXTURE_BORDER, 1),
    QUERY(GL_TEXTURE_INTERNAL_FORMAT, 1),
};
constexpr Query kTexEnvQueries[] = {QUERY(GL_TEXTURE_ENV_MODE, 1), QUERY(GL_TEXTURE_ENV_COLOR, 4)};
constexpr Query kTexGenQueries[] = {QUERY(GL_TEXTURE_GEN_MODE, 1), QUERY(GL_OBJECT_PLANE, 4),
                                    QUERY(GL_EYE_PLANE, 4)};
constexpr Query kPixelMaps[] = {
    QUERY(GL_PIXEL_MAP_I_TO_I, 0), QUERY(GL_PIXEL_MAP_S_TO_S, 0), QUERY(GL_PIXEL_MAP_I_TO_R, 0),
    QUERY(GL_PIXEL_MAP_I_TO_G, 0), QUERY(GL_PIXEL_MAP_I_TO_B, 0), QUERY(GL_PIXEL_MAP_I_TO_A, 0),
    QUERY(GL_PIXEL_MAP_R_TO_R, 0), QUERY(GL_PIXEL_MAP_G_TO_G, 0), QUERY(GL_PIXEL_MAP_B_TO_B, 0),
    QUERY(GL_PIXEL_MAP_A_TO_A, 0),
};
// `values`: components of a control point; two-dimensional ones second.
constexpr Query kEvaluatorMaps[] = {
    QUERY(GL_MAP1_COLOR_4, 4),         QUERY(GL_MAP1_INDEX, 1),           QUERY(GL_MAP1_NORMAL, 3),
    QUERY(GL_MAP1_TEXTURE_COORD_1, 1), QUERY(GL_MAP1_TEXTURE_COORD_2, 2), QUERY(GL_MAP1_TEXTURE_COORD_3, 3),
    QUERY(GL_MAP1_TEXTURE_COORD_4, 4), QUERY(GL_MAP1_VERTEX_3, 3),        QUERY(GL_MAP1_VERTEX_4, 4),
    QUERY(GL_MAP2_COLOR_4, 4),         QUERY(GL_MAP2_INDEX, 1),           QUERY(GL_MAP2_NORMAL, 3),
    QUERY(GL_MAP2_TEXTURE_COORD_1, 1), QUERY(GL_MAP2_TEXTURE_COORD_2, 2), QUERY(GL_MAP2_TEXTURE_COORD_3, 3),
    QUERY(GL_MAP2_TEXTURE_COORD_4, 4), QUERY(GL_MAP2_VERTEX_3, 3),        QUERY(GL_MAP2_VERTEX_4, 4),
};
// `values`: 1 where glPushClientAttrib saves it.
constexpr Query kPointers[] = {
    QUERY(GL_VERTEX_ARRAY_POINTER, 1),        QUERY(GL_NORMAL_ARRAY_POINTER, 1),
    QUERY(GL_COLOR_ARRAY_POINTER, 1),         QUERY(GL_INDEX_ARRAY_POINTER, 1),
    QUERY(GL_TEXTURE_COORD_ARRAY_POINTER, 1), QUERY(GL_EDGE_FLAG_ARRAY_POINTER, 1),
    QUERY(GL_FEEDBACK_BUFFER_POINTER, 0),     QUERY(GL_SELECTION_BUFFER_POINTER, 0),
};
#undef QUERY

class Taker {
 public:
  GlSnapshot take() {
    for (const StateRow& row : all_state_rows()) {
      add(row.text, row.groups, row.values, [&](GLdouble* v) { glGetDoublev(row.name, v); });
    }
    take_pointers();
    take_lighting();
    take_textures();
    for (GLenum i = 0; i < 6; ++i) {
      add("clip plane " + std::to_string(i), kTransform, 4,
          [&](GLdouble* v) { glGetClipPlane(GL_CLIP_PLANE0 + i, v); });
    }
    take_stipple();
    take_maps();
    return std::move(snapshot_);
  }

 private:
  // `read` fills as many values as it is told.
  template <class T = GLdouble, class Read>
  void add(const std::string& name, unsigned groups, int count, Read&& read) {
    std::vector<T> v(static_cast<size_t>(count) + 1, T(12345));
    read(v.data());
    snapshot_[name] = {{v.begin(), v.end() - 1}, groups};
  }

  void take_pointers() {
    for (const Query& query : kPointers) {
      GLvoid* pointer = nullptr;
      glGetPointerv(query.name, &pointer);
      const auto value = static_cast<double>(reinterpret_cast<uintptr_t>(pointer));
      snapshot_[query.text] = {{value}, query.values ? kClientVertexArray : kNone};
    }
  }

  void take_lighting() {
    for (GLenum i = 0; i < 8; ++i) {
      for (const Query& query : kLightQueries) {
        add<GLfloat>("light " + std::to_string(i) + " " + query.text, kLighting, query.values,
                     [&](GLfloat* v) { glGetLightfv(GL_LIGHT0 + i, query.name, v); });
      }
    }
    for (const GLenum face : std::initializer_list<GLenum>{GL_FRONT, GL_BACK}) {
      for (const Query& query : kMaterialQueries) {
        const char* side = face == GL_FRONT ? "front " : "back ";
        add<GLfloat>(std::string(side) + query.text, kLighting, query.values,
                     [&](GLfloat* v) { glGetMaterialfv(face, query.name, v); });
      }
    }
  }

  void take_textures() {
    for (const GLenum target : std::initializer_list<GLenum>{GL_TEXTURE_1D, GL_TEXTURE_2D}) {
      const std::string side = target == GL_TEXTURE_1D ? "1D " : "2D ";
      for (const Query& query : kTexParameterQueries) {
        add<GLfloat>(side + query.text, kTexture, query.values,
                     [&](GLfloat* v) { glGetTexParameterfv(target, query.name, v); });
      }
      for (const Query& query : kTexLevelQueries) {
        add<GLfloat>(side + query.text, kTexture, query.values,
                     [&](GLfloat* v) { glGetTexLevelParameterfv(target, 0, query.name, v); });
      }
    }
    for (const Query& query : kTexEnvQueries) {
      add<GLfloat>(query.text, kTexture, query.values,
                   [&](GLfloat* v) { glGetTexEnvfv(GL_TEXTURE_ENV, query.name, v); });
    }
    for (const GLenum coord : std::initializer_list<GLenum>{GL_S, GL_T, GL_R, GL_Q}) {
      for (const Query& query : kTexGenQueries) {
        add("texgen " + std::to_string(coord - GL_S) + " " + query.text, kTexture, query.values,
            [&](GLdouble* v) { glGetTexGendv(coord, query.name, v); });
      }
    }
  }

  // The pattern comes through the pixel store, which is set aside for it.
  void take_stipple() {
    constexpr GLenum kNames[] = {GL_PACK_ALIGNMENT, GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH,
                                 GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS};
    GLint old[5];
    for (size_t i = 0; i < 5; ++i) {
      glGetIntegerv(kNames[i], &old[i]);
      glPixelStorei(kNames[i], i == 0 ? 1 : 0);
    }
    add<GLubyte>("polygon stipple", kPolygonStipple, 128, [](GLubyte* v) { glGetPolygonStipple(v); });
    for (size_t i = 0; i < 5; ++i) glPixelStorei(kNames[i], old[i]);
  }

  void take_maps() {
    for (const Query& query : kPixelMaps) {
      // GL_PIXEL_MAP_I_TO_I .. A_TO_A and their sizes are numbered alike.
      GLint size = 0;
      glGetIntegerv(GL_PIXEL_MAP_I_TO_I_SIZE + (query.name - GL_PIXEL_MAP_I_TO_I), &size);
      add<GLfloat>(query.text, kNone, size, [&](GLfloat* v) { glGetPixelMapfv(query.name, v); });
    }
    for (const Query& query : kEvaluatorMaps) {
      const int dimensions = query.name < GL_MAP2_COLOR_4 ? 1 : 2;
      const std::string map = std::string("map ") + query.text;
      GLint order[2] = {0, 1};
      glGetMapiv(query.name, GL_ORDER, order);
      add(map + " order", kNone, 2, [&](GLdouble* v) { v[0] = order[0], v[1] = order[1]; });
      add(map + " domain", kNone, 2 * dimensions, [&](GLdouble* v) { glGetMapdv(query.name, GL_DOMAIN, v); });
      add(map + " points", kNone, order[0] * order[1] * query.values,
          [&](GLdouble* v) { glGetMapdv(query.name, GL_COEFF, v); });
    }
  }

  GlSnapshot snapshot_;
};

}  // namespace

const std::vector<StateRow>& all_state_rows() {
  static const std::vector<StateRow> rows = {
#define STATE(name, values, groups) {#name, name, values, groups, true},
#define LIMIT(name, values) {#name, name, values, kNone, false},
#include "tests/api/gl_state.def"
#undef STATE
#undef LIMIT
  };
  return rows;
}

GlSnapshot take_gl_snapshot() { return Taker().take(); }

std::string differences(const GlSnapshot& expected, const GlSnapshot& found) {
  std::ostringstream out;
  const auto print = [&out](const StateValue& value) {
    for (const double v : value.values) out << ' ' << v;
  };
  int lines = 0;
  for (const auto& [name, value] : expected) {
    const auto other = found.find(name);
    if (other != found.end() && other->second == value) continue;
    if (++lines > 10) return out.str() + "  and more\n";
    out << "  " << name << ": expected";
    print(value);
    out << ", found";
    if (other != found.end()) print(other->second);
    out << '\n';
  }
  return out.str();
}

}  // namespace halfspace::test
