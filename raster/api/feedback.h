// Primitives as they leave clipping, culling and the polygon mode: for selection and feedback (spec 5.2, 5.3).
#pragma once

#include <span>

#include "raster/api/types.h"

namespace halfspace::raster {

struct FeedbackVertex {
  double x, y, z;  // window coordinates: pixels, depth in [0, 1]
  double w;        // clip-space w
  Color color;
  double s, t, r, q;
};

// Called in the order of drawing, on the thread that draws. Nothing is rasterised.
class FeedbackSink {
 public:
  virtual ~FeedbackSink() = default;
  // Whether colours and texture coordinates are looked at; without, they are not worked out.
  virtual bool needs_attributes() const { return true; }
  virtual void point(const FeedbackVertex& v) = 0;
  // `reset`: the line stipple starts anew with this line.
  virtual void line(const FeedbackVertex& a, const FeedbackVertex& b, bool reset) = 0;
  virtual void polygon(std::span<const FeedbackVertex> vertices) = 0;
};

}  // namespace halfspace::raster
