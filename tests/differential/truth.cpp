#include "tests/differential/truth.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <thread>

namespace halfspace::differential {
namespace {

constexpr uint32_t kDepthMax = (1u << 24) - 1;
constexpr int kBandRows = 16;

struct Piece {
  TrueTriangle triangle;
  Owner owner;
  uint16_t draw;
};

Real clamped(float v) { return std::clamp(static_cast<Real>(v), 0.0L, 1.0L); }

Corner corner_of(const Recording::Draw& draw, uint32_t index) {
  const ref_app::Vertex& v = draw.geometry.vertices[index];
  const glm::vec4& c = v.color;
  return {to_clip(draw.state, v.position),
          {clamped(c.r), clamped(c.g), clamped(c.b), clamped(c.a)},
          {static_cast<Real>(v.tex_coord.x), static_cast<Real>(v.tex_coord.y)}};
}

// A quad is the triangles 0 1 3 and 1 2 3, as the house splits it.
std::vector<std::array<Corner, 3>> triangles_of(const Recording::Draw& draw, size_t primitive) {
  const PrimitiveCorners corners = primitive_at(draw.geometry, primitive);
  const auto corner = [&](size_t i) { return corner_of(draw, corners.vertex[i]); };
  if (corners.count == 3) return {{corner(0), corner(1), corner(2)}};
  return {{corner(0), corner(1), corner(3)}, {corner(1), corner(2), corner(3)}};
}

std::vector<Piece> pieces_of(const Recording& recording, Positions positions) {
  std::vector<Piece> pieces;
  Owner owner = 0;
  uint16_t draw_number = 0;
  for (const Recording::Draw& draw : recording.draws) {
    ++draw_number;
    for (size_t i = 0; i < primitive_count(draw.geometry); ++i) {
      ++owner;
      for (const std::array<Corner, 3>& corners : triangles_of(draw, i))
        pieces.push_back(
            {TrueTriangle(corners, recording.width, recording.height, positions), owner, draw_number});
    }
  }
  return pieces;
}

// Runs work(y0, y1) over bands of rows on all cores; the first exception comes out again.
void over_bands(int height, const std::function<void(int, int)>& work) {
  const unsigned count = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> threads;
  std::vector<std::exception_ptr> failures(count);
  for (unsigned i = 0; i < count; ++i) {
    threads.emplace_back([&, i] {
      try {
        for (int y = static_cast<int>(i) * kBandRows; y < height; y += static_cast<int>(count) * kBandRows)
          work(y, std::min(y + kBandRows, height));
      } catch (...) {
        failures[i] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

class Painter {
 public:
  Painter(const Recording& recording, const Model& model)
      : recording_(recording), filter_(model.filter), pieces_(pieces_of(recording, model.positions)) {
    const size_t pixels = static_cast<size_t>(recording.width) * static_cast<size_t>(recording.height);
    truth_.width = recording.width, truth_.height = recording.height;
    truth_.owner.resize(pixels);
    truth_.color.resize(pixels);
    truth_.draw.resize(pixels);
    seen_.assign(pixels, -1);
    const Real clear = clamped(recording.pass.clear_depth);
    depth_.assign(pixels, static_cast<uint32_t>(std::floor(clear * kDepthMax + 0.5L)));
  }

  Truth paint() {
    over_bands(recording_.height, [this](int y0, int y1) {
      for (size_t i = 0; i < pieces_.size(); ++i) decide(i, y0, y1);
      for (int y = y0; y < y1; ++y) {
        for (int x = 0; x < recording_.width; ++x) shade(x, y);
      }
    });
    return std::move(truth_);
  }

 private:
  // GL_LESS, or no test at all.
  void decide(size_t piece, int y0, int y1) {
    const TrueTriangle& triangle = pieces_[piece].triangle;
    const bool test = recording_.draws[pieces_[piece].draw - 1u].state.depth_test;
    triangle.for_each_pixel(y0, y1, [&](int x, int y) {
      const size_t at = truth_.index(x, y);
      if (test) {
        const uint32_t depth = triangle.depth(x, y);
        if (depth >= depth_[at]) return;
        depth_[at] = depth;
      }
      seen_[at] = static_cast<int64_t>(piece);
    });
  }

  void shade(int x, int y) {
    const size_t at = truth_.index(x, y);
    std::array<Real, 4> color;
    if (seen_[at] < 0) {
      const glm::vec4& c = recording_.pass.clear_color;
      color = {clamped(c.r), clamped(c.g), clamped(c.b), clamped(c.a)};
    } else {
      const Piece& piece = pieces_[static_cast<size_t>(seen_[at])];
      const Recording::Draw& draw = recording_.draws[piece.draw - 1u];
      truth_.owner[at] = piece.owner;
      truth_.draw[at] = piece.draw;
      const std::array<Real, 6> value = piece.triangle.attributes(x, y);
      color = {value[0], value[1], value[2], value[3]};
      if (const ref_app::Image* image = recording_.image_of(draw)) {
        const std::array<Real, 4> texel = sample(filter_, *image, value[4], value[5]);
        for (size_t i = 0; i < 4; ++i) color[i] *= texel[i];  // GL_MODULATE
      }
    }
    for (size_t i = 0; i < 4; ++i) {
      truth_.color[at][i] = static_cast<double>(std::clamp(color[i], 0.0L, 1.0L) * 255);
    }
  }

  const Recording& recording_;
  const Filter filter_;
  const std::vector<Piece> pieces_;
  Truth truth_;
  std::vector<int64_t> seen_;  // the piece that shows; -1: none
  std::vector<uint32_t> depth_;
};

}  // namespace

bool Truth::interior(int x, int y) const {
  const uint16_t own = draw[index(x, y)];
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny) {
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
      if (draw[index(nx, ny)] != own) return false;
    }
  }
  return true;
}

std::optional<double> distance_to_edge(const Recording& recording, Owner owner, int x, int y) {
  size_t before = 0;
  for (const Recording::Draw& draw : recording.draws) {
    const size_t count = primitive_count(draw.geometry);
    if (owner > before && owner <= before + count) {
      double nearest = 1e300;
      for (const std::array<Corner, 3>& corners : triangles_of(draw, owner - before - 1)) {
        const TrueTriangle triangle(corners, recording.width, recording.height, Positions::snapped);
        nearest = std::min(nearest, triangle.distance_to_edge(x, y));
      }
      return nearest;
    }
    before += count;
  }
  return std::nullopt;
}

Truth true_picture(const Recording& recording, const Model& model) {
  return Painter(recording, model).paint();
}

}  // namespace halfspace::differential
