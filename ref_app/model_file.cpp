#include "ref_app/model_file.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ref_app/input_error.h"

namespace ref_app {
namespace {

constexpr size_t kMostCorners = 30'000'000;  // ten million triangles
constexpr float kTeapotHeight = 3.15F;

class ModelReader {
 public:
  ModelReader(const std::string& path, const TeapotLook& look) : path_(path), look_(look) {
    tinyobj::ObjReaderConfig config;
    config.triangulate = true;
    config.mtl_search_path = "";
    if (!reader_.ParseFromFile(path, config)) {
      std::string why = reader_.Error();
      while (!why.empty() && why.back() == '\n') why.pop_back();
      fail(why.empty() ? "it is not a Wavefront OBJ file" : why);
    }
  }

  Geometry read() {
    for (const tinyobj::shape_t& shape : reader_.GetShapes()) {
      const std::vector<tinyobj::index_t>& corners = shape.mesh.indices;
      if (mesh_.indices.size() + corners.size() > kMostCorners) fail("it has too many triangles");
      for (size_t i = 0; i + 2 < corners.size(); i += 3) add_triangle(&corners[i]);
    }
    if (mesh_.indices.empty()) fail("it holds no triangles");
    fit();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError("cannot read the model " + path_ + ": " + why);
  }

  // The element `index` of a flat array of `size` floats an element; the reader does not check indices.
  const float* element(const std::vector<float>& values, int index, size_t size, const char* what) const {
    if (index < 0 || (static_cast<size_t>(index) + 1) * size > values.size()) {
      fail(std::string("a face names a ") + what + " that is not there");
    }
    return &values[static_cast<size_t>(index) * size];
  }

  glm::vec3 position(const tinyobj::index_t& corner) const {
    const float* p = element(reader_.GetAttrib().vertices, corner.vertex_index, 3, "vertex");
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      fail("a vertex is not a finite number");
    return {p[0], p[1], p[2]};
  }

  void add_triangle(const tinyobj::index_t* corners) {
    const tinyobj::attrib_t& attributes = reader_.GetAttrib();
    const std::array<glm::vec3, 3> points{position(corners[0]), position(corners[1]), position(corners[2])};
    const glm::vec3 cross = glm::cross(points[1] - points[0], points[2] - points[0]);
    const float area = glm::length(cross);
    const glm::vec3 flat = area > 0 ? cross / area : glm::vec3(0, 1, 0);
    for (size_t i = 0; i < 3; ++i) {
      glm::vec3 normal = flat;
      glm::vec2 tex_coord(0);
      if (corners[i].normal_index >= 0) {
        const float* n = element(attributes.normals, corners[i].normal_index, 3, "normal");
        const float length = glm::length(glm::vec3(n[0], n[1], n[2]));
        if (length > 0 && std::isfinite(length)) normal = glm::vec3(n[0], n[1], n[2]) / length;
      }
      if (corners[i].texcoord_index >= 0) {
        const float* t = element(attributes.texcoords, corners[i].texcoord_index, 2, "texture coordinate");
        tex_coord = {t[0], t[1]};
      }
      mesh_.indices.push_back(static_cast<uint32_t>(mesh_.vertices.size()));
      mesh_.vertices.push_back({{points[i], 1.0F}, {baked_color(look_, normal), 1.0F}, tex_coord});
    }
  }

  void fit() {
    glm::vec3 low(INFINITY), high(-INFINITY);
    for (const Vertex& v : mesh_.vertices) {
      low = glm::min(low, glm::vec3(v.position));
      high = glm::max(high, glm::vec3(v.position));
    }
    const glm::vec3 size = high - low;
    const float largest = glm::max(size.y, glm::max(size.x, size.z) * 0.5F);
    if (!std::isfinite(largest) || largest <= 0) fail("its points all lie in one place");
    const float scale = kTeapotHeight / largest;
    const glm::vec3 foot(0.5F * (low.x + high.x), low.y, 0.5F * (low.z + high.z));
    for (Vertex& v : mesh_.vertices) v.position = {(glm::vec3(v.position) - foot) * scale, 1.0F};
  }

  std::string path_;
  TeapotLook look_;
  tinyobj::ObjReader reader_;
  Geometry mesh_;
};

}  // namespace

Geometry load_model(const std::string& path, const TeapotLook& look) {
  try {
    return ModelReader(path, look).read();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& failure) {
    throw InputError("cannot read the model " + path + ": " + failure.what());
  }
}

}  // namespace ref_app
