#include "tests/support/canvas.h"

#include <cstdlib>
#include <sstream>

namespace halfspace::test {

using namespace raster;

Canvas::Canvas(int width, int height, int threads, ColorFormat format, bool fuse)
    : framebuffer_(std::make_unique<Framebuffer>(width, height, format)) {
  DeviceOptions options;
  options.threads = threads;
  options.fuse = fuse;
  device_ = std::make_unique<Device>(options);
  device_->begin_pass(framebuffer_.get());
  clear();
}

void Canvas::clear(const Color& color, double depth) {
  ClearCommand command;
  command.color = command.depth = true;
  command.color_value = color;
  command.depth_value = depth;
  device_->clear(command);
}

namespace {

DrawPacket packet_of(const DrawState& state, Primitive primitive, std::span<const Vertex> vertices) {
  DrawPacket packet;
  packet.state = std::make_shared<DrawState>(state);
  packet.primitive = primitive;
  packet.batch.count = uint32_t(vertices.size());
  packet.batch.position = {&vertices[0].x, sizeof(Vertex), 4};
  packet.index_count = packet.batch.count;
  return packet;
}

}  // namespace

void Canvas::draw(const DrawState& state, Primitive primitive, std::span<const Vertex> vertices,
                  std::span<const uint32_t> indices) {
  if (vertices.empty()) return;
  DrawPacket packet = packet_of(state, primitive, vertices);
  packet.batch.color = {&vertices[0].color, sizeof(Vertex), 4};
  packet.batch.tex_coord = {&vertices[0].s, sizeof(Vertex), 4};
  if (!indices.empty()) {
    packet.indices = indices.data();
    packet.index_count = uint32_t(indices.size());
  }
  device_->draw(packet);
}

void Canvas::draw_plain(const DrawState& state, Primitive primitive, std::span<const Vertex> vertices,
                        const Color& color) {
  if (vertices.empty()) return;
  DrawPacket packet = packet_of(state, primitive, vertices);
  packet.batch.color = {&color, 0, 4};
  device_->draw(packet);
}

Picture Canvas::read() { return read({0, 0, width(), height()}); }

Picture Canvas::read(const Rect& rect) {
  Picture picture;
  picture.width = rect.x1 - rect.x0;
  picture.height = rect.y1 - rect.y0;
  const size_t pixels = size_t(picture.width) * size_t(picture.height);
  picture.rgba.resize(4 * pixels);
  picture.depth.resize(pixels);
  device_->read_color(rect, picture.rgba.data());
  device_->read_depth(rect, picture.depth.data());
  return picture;
}

DrawState plain_state(int width, int height, int x, int y) {
  DrawState state;
  state.viewport.x = x;
  state.viewport.y = y;
  state.viewport.width = width;
  state.viewport.height = height;
  return state;
}

float clip_of(int64_t snapped, int size) {
  const int64_t half = int64_t{128} * size;
  return float(snapped - half) / float(half);
}

Vertex snapped_vertex(int64_t x, int64_t y, int viewport_size, float z, const Color& color) {
  Vertex vertex;
  vertex.x = clip_of(x, viewport_size);
  vertex.y = clip_of(y, viewport_size);
  vertex.z = z;
  vertex.color = color;
  return vertex;
}

std::vector<Vertex> snapped_quad(int64_t x0, int64_t y0, int64_t x1, int64_t y1, int viewport_size, float z,
                                 const Color& color) {
  return {snapped_vertex(x0, y0, viewport_size, z, color), snapped_vertex(x1, y0, viewport_size, z, color),
          snapped_vertex(x1, y1, viewport_size, z, color), snapped_vertex(x0, y1, viewport_size, z, color)};
}

uint64_t hash(const Picture& picture) {
  uint64_t h = 14695981039346656037u;
  const auto add = [&h](uint8_t byte) { h = (h ^ byte) * 1099511628211u; };
  for (uint8_t byte : picture.rgba) add(byte);
  for (uint32_t depth : picture.depth) {
    for (int shift = 0; shift < 32; shift += 8) add(uint8_t(depth >> shift));
  }
  return h;
}

std::vector<std::string> isa_levels() {
  std::istringstream names{std::string(isa_available())};
  std::vector<std::string> levels;
  for (std::string name; names >> name;) levels.push_back(name);
  return levels;
}

IsaScope::IsaScope(const std::string& name) : before_(isa_name()) {
  if (!set_isa(name)) std::abort();
}
IsaScope::~IsaScope() { set_isa(before_); }

bool long_tests() {
  const char* value = std::getenv("HALFSPACE_LONG_TESTS");
  return value && *value && *value != '0';
}

std::string first_difference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return "the sizes differ";
  size_t count = 0;
  std::ostringstream first;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const uint8_t *p = a.pixel(x, y), *q = b.pixel(x, y);
      if (std::equal(p, p + 4, q) && a.depth_at(x, y) == b.depth_at(x, y)) continue;
      if (count++ != 0) continue;
      first << "(" << x << ", " << y << "): ";
      for (const uint8_t* c : {p, q})
        first << int(c[0]) << " " << int(c[1]) << " " << int(c[2]) << " " << int(c[3]) << "; ";
      first << "depth " << a.depth_at(x, y) << " and " << b.depth_at(x, y);
    }
  }
  if (count == 0) return {};
  return std::to_string(count) + " pixels differ, first " + first.str();
}

}  // namespace halfspace::test
