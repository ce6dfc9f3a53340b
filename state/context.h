// A GL context: the attribute groups of the specification, side by side. The work is in the groups' own
// files.
#pragma once

#include <memory>

#include "raster/api/device.h"
#include "state/accum.h"
#include "state/attribute_stack.h"
#include "state/capability.h"
#include "state/clip_plane.h"
#include "state/color_buffer.h"
#include "state/current.h"
#include "state/depth_buffer.h"
#include "state/derive/derived.h"
#include "state/display_list.h"
#include "state/drawable.h"
#include "state/error.h"
#include "state/evaluator.h"
#include "state/feedback.h"
#include "state/fog.h"
#include "state/hint.h"
#include "state/immediate.h"
#include "state/lighting.h"
#include "state/line.h"
#include "state/pixel_map.h"
#include "state/pixel_store.h"
#include "state/pixel_transfer.h"
#include "state/point.h"
#include "state/polygon.h"
#include "state/render_mode.h"
#include "state/raster_position.h"
#include "state/scissor.h"
#include "state/selection.h"
#include "state/stencil.h"
#include "state/tex_gen.h"
#include "state/texture.h"
#include "state/transform.h"
#include "state/vertex_array.h"
#include "state/viewport.h"

namespace halfspace::state {

struct OperationTable;  // state/operations.gen.h

struct Context {
  // `share`: context whose texture objects and display lists this one uses too, or null.
  Context(const VisualConfig& visual, Context* share);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  VisualConfig visual;
  Drawable* drawable = nullptr;  // null while not current
  Drawable* read_drawable =
      nullptr;                  // where pixels are read, when it is not `drawable` (glXMakeContextCurrent)
  bool was_current = false;     // the first make-current sets viewport and scissor to the drawable's size
  const OperationTable* table;  // what executes commands now: outside, or inside Begin/End

  ErrorState error;
  CapabilityState capability;
  CurrentState current;
  TransformState transform;
  ViewportState viewport;
  ScissorState scissor;
  ClipPlaneState clip_plane;
  PointState point;
  LineState line;
  PolygonState polygon;
  PolygonStippleState polygon_stipple;
  bool wireframe = false;  // HALFSPACE_VIEW=wireframe: fill shows edges; no query tells of it
  LightingState lighting;
  DepthBufferState depth_buffer;
  StencilBufferState stencil_buffer;
  ColorBufferState color_buffer;
  AccumState accum;
  FogState fog;
  HintState hint;
  TextureState texture;
  TexGenState tex_gen;
  PixelStoreState pixel_store;
  PixelTransferState pixel_transfer;
  PixelMapState pixel_map;
  RasterPositionState raster_position;
  VertexArrayState vertex_array;
  ImmediateState immediate;
  AttributeStackState attribute_stack;
  ListState list;
  ListMachine lists;
  RenderModeState render_mode;
  SelectionState selection;
  FeedbackState feedback;
  EvaluatorState evaluator;
  EvaluatorMaps maps;
  DerivedState derived;

  raster::Device device;
};

// The calling thread's context and its table; null and the table of no-operations when there is none. Read by
// every entry point, hence initial-exec, and constinit: no call to see whether it is initialised.
struct CurrentBinding {
  Context* context;
  const OperationTable* table;
};
extern constinit thread_local CurrentBinding current_binding __attribute__((tls_model("initial-exec")));

// Makes `context` current on `drawable` for the calling thread; both null releases. Work pending in the
// context that was current is executed first (as glFlush). Also the way a front end says that the drawable
// changed its size.
void make_current(Context* context, Drawable* drawable);

// Executes all drawing and brings to light what can be seen without a swap: glFlush and glFinish. May throw
// std::bad_alloc.
void execute_drawing(Context& context);

// Swaps which operations execute commands (Begin, End). Entry points reach them directly, or between NewList
// and EndList through the table that compiles.
void set_table(Context& context, const OperationTable& table);

}  // namespace halfspace::state
