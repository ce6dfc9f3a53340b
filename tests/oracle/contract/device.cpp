// The renderer of raster/api, drawn by the oracle: everything at once, one pixel after the other.
//
// HALFSPACE_TRUTH=DIR writes the truth of every frame that is shown (tests/oracle/truth_file.h).
// HALFSPACE_TRUTH_DOUBT=0.0001 says how far off colours may be before they are rounded, in levels; 0.05 if
// nothing does. HALFSPACE_TRUTH_POSITIONS=unsnapped takes polygons' coverage from corners that are not
// rounded to 1/256 px.
#include "raster/api/device.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/oracle/assembly.h"
#include "tests/oracle/buffers.h"
#include "tests/oracle/contract/image.h"
#include "tests/oracle/contract/impl.h"
#include "tests/oracle/feedback.h"
#include "tests/oracle/pixels.h"
#include "tests/oracle/truth_file.h"

namespace halfspace::raster {
namespace {

oracle::Positions positions_from_environment() {
  const char* wish = std::getenv("HALFSPACE_TRUTH_POSITIONS");
  if (wish == nullptr || *wish == '\0' || std::strcmp(wish, "snapped") == 0)
    return oracle::Positions::snapped;
  if (std::strcmp(wish, "unsnapped") != 0)
    std::fprintf(stderr, "halfspace oracle: HALFSPACE_TRUTH_POSITIONS=%s is neither snapped nor unsnapped\n",
                 wish);
  return oracle::Positions::unsnapped;
}

oracle::Real doubt_from_environment() {
  const char* wish = std::getenv("HALFSPACE_TRUTH_DOUBT");
  return wish != nullptr && *wish != '\0' ? std::strtold(wish, nullptr) : oracle::kLevelDoubt;
}

// Frames are counted through all contexts of a program.
unsigned next_frame() {
  static unsigned frames = 0;
  return frames++;
}

}  // namespace

struct Device::Impl {
  Framebuffer::Impl* framebuffer = nullptr;
  DeviceStatistics statistics;
  const oracle::Positions positions = positions_from_environment();
  const oracle::Real level_doubt = doubt_from_environment();
  const char* const truth_directory = std::getenv("HALFSPACE_TRUTH");
  oracle::Progress progress;
  uint32_t draws = 0;  // of the frame so far
  bool shown = false;  // the frame has been shown: what comes next is another one
  bool drawn = false;  // there is something to show
  std::shared_ptr<const TextureView> texture_view;  // what `texture` was made from
  oracle::Texture texture;

  oracle::Target& target() { return framebuffer->target; }

  void start_work() {
    if (shown) progress.primitives = draws = 0;
    shown = false;
    drawn = true;
  }

  const oracle::Texture* texture_of(const DrawState& state) {
    if (!state.texture.view) return nullptr;
    if (texture_view == state.texture.view) return &texture;
    texture_view = state.texture.view;
    texture = {{}, texture_view->sampler, texture_view->base_format};
    for (int n = 0; n < texture_view->level_count; ++n)
      texture.levels.push_back(texture_view->levels[static_cast<size_t>(n)]->level);
    return &texture;
  }

  void show(ColorPlane plane) {
    shown = true;
    const unsigned frame =
        next_frame();  // counted as HALFSPACE_CAPTURE counts, but written only where something is new
    if (truth_directory == nullptr || *truth_directory == '\0' || !drawn) return;
    drawn = false;
    if (!oracle::write_truth(target(), plane, truth_directory, frame))
      std::fprintf(stderr, "halfspace oracle: cannot write to %s\n", truth_directory);
  }
};

Device::Device(const DeviceOptions&) : impl_(std::make_unique<Impl>()) {}
Device::~Device() = default;

void Device::begin_pass(Framebuffer* target) { impl_->framebuffer = target ? &target->impl() : nullptr; }

void Device::clear(const ClearCommand& command) {
  if (!impl_->framebuffer) return;
  impl_->start_work();
  oracle::clear(impl_->target(), command);
}

void Device::draw(const DrawPacket& packet) {
  if (!impl_->framebuffer || packet.batch.count == 0 || packet.index_count == 0) return;
  impl_->start_work();
  ++impl_->statistics.draws;
  impl_->statistics.vertices += packet.batch.count;
  oracle::Painter painter(impl_->target(), *packet.state, impl_->texture_of(*packet.state), ++impl_->draws,
                          impl_->level_doubt);
  oracle::Assembly(painter, packet, impl_->positions, impl_->progress).run();
}

void Device::draw_pixels(const PixelPacket& packet) {
  if (!impl_->framebuffer) return;
  impl_->start_work();
  ++impl_->statistics.draws;
  oracle::Painter painter(impl_->target(), *packet.state, impl_->texture_of(*packet.state), ++impl_->draws,
                          impl_->level_doubt);
  painter.start_primitive(++impl_->progress.primitives, false);
  oracle::draw_pixels(packet, impl_->target(), painter);
}

void Device::accumulate(const AccumCommand& command) {
  if (!impl_->framebuffer) return;
  impl_->start_work();
  oracle::accumulate(impl_->target(), command);
}

void Device::finish(const LinearImage* image, ColorPlane plane) {
  if (!impl_->framebuffer || !image) return;
  oracle::store_image(impl_->target(), plane, *image);
  impl_->show(plane);
}

void Device::copy_plane(ColorPlane from, ColorPlane to, const Rect& rect) {
  if (impl_->framebuffer) oracle::copy_plane(impl_->target(), from, to, rect);
}

const DeviceStatistics& Device::statistics() const { return impl_->statistics; }

namespace {

// visit(place of the pixel in the target, in `rect`).
template <class Visit>
void for_pixels_of(const oracle::Target& target, const Rect& rect, Visit visit) {
  const Rect inside = intersect(target.bounds(), rect);
  const auto width = static_cast<size_t>(rect.x1 - rect.x0);
  for (int y = inside.y0; y < inside.y1; ++y)
    for (int x = inside.x0; x < inside.x1; ++x)
      visit(target.at(x, y), static_cast<size_t>(y - rect.y0) * width + static_cast<size_t>(x - rect.x0));
}

}  // namespace

void Device::read_color(const Rect& rect, uint8_t* out, ColorPlane plane) {
  if (!impl_->framebuffer) return;
  const auto& pixels = impl_->target().color[static_cast<size_t>(oracle::place_of_plane(plane))];
  for_pixels_of(impl_->target(), rect, [&](size_t from, size_t to) {
    for (size_t k = 0; k < 4; ++k) out[4 * to + k] = pixels[from].byte[k];
  });
}

void Device::read_color_float(const Rect& rect, float* out, ColorPlane plane) {
  if (!impl_->framebuffer) return;
  const auto& pixels = impl_->target().color[static_cast<size_t>(oracle::place_of_plane(plane))];
  const bool bytes = impl_->target().format == ColorFormat::rgba8;
  for_pixels_of(impl_->target(), rect, [&](size_t from, size_t to) {
    for (size_t k = 0; k < 4; ++k)
      out[4 * to + k] = bytes ? static_cast<float>(pixels[from].byte[k]) / 255.0f : pixels[from].value[k];
  });
}

void Device::read_depth(const Rect& rect, uint32_t* out) {
  if (!impl_->framebuffer) return;
  for_pixels_of(impl_->target(), rect,
                [&](size_t from, size_t to) { out[to] = impl_->target().depth[from].stored; });
}

void Device::read_stencil(const Rect& rect, uint8_t* out) {
  if (!impl_->framebuffer) return;
  for_pixels_of(impl_->target(), rect,
                [&](size_t from, size_t to) { out[to] = impl_->target().stencil[from]; });
}

ShadedPoint Device::shade_point(const DrawState& state, const VertexBatch& batch) {
  const oracle::Vertex vertex = oracle::shade_vertex(state, batch, {}, 0);
  const oracle::ClipVolume volume(state, impl_->positions);
  const oracle::Corner& c = vertex.corner;
  ShadedPoint point;
  point.valid = vertex.usable && volume.holds(c);
  if (!point.valid) return point;
  const auto number = [](oracle::Wide v) { return static_cast<double>(v); };
  const oracle::Place<oracle::Wide> at = oracle::place_of(c, state.viewport);
  point.x = number(at.x / 256), point.y = number(at.y / 256), point.w = number(c.w);
  const auto near = static_cast<oracle::Wide>(state.viewport.depth_near);
  const auto far = static_cast<oracle::Wide>(state.viewport.depth_far);
  point.z = number(
      oracle::held((far - near) / 2 * (c.z / c.w) + (near + far) / 2, oracle::wide(0), oracle::wide(1)));
  point.eye_distance = number(c.value[oracle::kFogDistance]);
  const auto color = [&](size_t k) { return static_cast<float>(c.value[oracle::kRed + k]); };
  point.color = {color(0), color(1), color(2), color(3)};
  for (size_t k = 0; k < 4; ++k) point.tex_coord[k] = number(c.value[oracle::kCoordS + k]);
  return point;
}

void Device::feedback(const DrawPacket& packet, FeedbackSink& sink) {
  if (packet.batch.count != 0) oracle::feed_back(packet, sink);
}

std::string_view isa_name() { return "oracle"; }
std::string_view isa_available() { return "oracle"; }
bool set_isa(std::string_view name) { return name == "oracle"; }

}  // namespace halfspace::raster
