// What each bit of glPushAttrib saves (spec 6.1.14 and the state tables): the list of groups, and those which
// are not simply a struct of the context.
#pragma once

#include <bitset>
#include <memory>
#include <tuple>

#include "state/context.h"

namespace halfspace::state {

// A struct of the context that belongs to the group as a whole.
template <auto kMember>
struct Whole {
  std::remove_cvref_t<decltype(std::declval<Context&>().*kMember)> value;
  void save(const Context& context) { value = context.*kMember; }
  void restore(Context& context) const { context.*kMember = value; }
};

// A part of such a struct.
template <auto kMember, auto kField>
struct Part {
  std::remove_cvref_t<decltype(std::declval<Context&>().*kMember.*kField)> value;
  void save(const Context& context) { value = context.*kMember.*kField; }
  void restore(Context& context) const { context.*kMember.*kField = value; }
};

// GL_COLOR_BUFFER_BIT: all but the read buffer, which is GL_PIXEL_MODE_BIT's.
struct SavedColorBuffer {
  ColorBufferState value;
  void save(const Context& context) { value = context.color_buffer; }
  void restore(Context& context) const;
};

// GL_ENABLE_BIT: everything glEnable knows.
struct SavedEnables {
  std::bitset<kMaxCapabilities> value;
  void save(const Context& context);
  void restore(Context& context) const;
};

// GL_TEXTURE_BIT: the unit, the bindings, and the parameters of the objects that were bound.
struct SavedTextures {
  struct Binding {
    std::shared_ptr<TextureObject> object;
    TextureParameters parameters;
    bool is_default;  // the context's own object, of name 0
  };
  bool enabled_1d, enabled_2d;
  GLenum env_mode;
  raster::Color env_color;
  std::shared_ptr<TextureNamespace> names;
  Binding bound_1d, bound_2d;
  void save(const Context& context);
  void restore(Context& context) const;
  void release() { *this = {}; }
};

// kDirtyBits: what is derived from the group.
template <GLbitfield kGroupBits, class Saved, uint32_t kDirtyBits = kDirtyAll>
struct Group {
  static constexpr GLbitfield kBits = kGroupBits;
  static constexpr uint32_t kDirty = kDirtyBits;
  Saved saved;
};

// A new group, or one that comes by another struct, is a line here.
// The first alone may throw (std::bad_alloc): what is refused changes nothing.
using AttributeGroups = std::tuple<                                                             //
    Group<GL_ACCUM_BUFFER_BIT, Whole<&Context::accum>, 0>,                                      //
    Group<GL_COLOR_BUFFER_BIT, SavedColorBuffer>,                                               //
    Group<GL_CURRENT_BIT, Whole<&Context::current>, 0>,                                         //
    Group<GL_CURRENT_BIT, Whole<&Context::raster_position>, 0>,                                 //
    Group<GL_DEPTH_BUFFER_BIT, Whole<&Context::depth_buffer>>,                                  //
    Group<GL_ENABLE_BIT, SavedEnables>,                                                         //
    Group<GL_EVAL_BIT, Whole<&Context::evaluator>, 0>,                                          //
    Group<GL_FOG_BIT, Whole<&Context::fog>>,                                                    //
    Group<GL_HINT_BIT, Whole<&Context::hint>>,                                                  //
    Group<GL_LIGHTING_BIT, Whole<&Context::lighting>>,                                          //
    Group<GL_LIST_BIT, Whole<&Context::list>, 0>,                                               //
    Group<GL_LINE_BIT, Whole<&Context::line>>,                                                  //
    Group<GL_PIXEL_MODE_BIT, Part<&Context::color_buffer, &ColorBufferState::read_buffer>, 0>,  //
    Group<GL_PIXEL_MODE_BIT, Whole<&Context::pixel_transfer>, 0>,                               //
    Group<GL_POINT_BIT, Whole<&Context::point>>,                                                //
    Group<GL_POLYGON_BIT, Whole<&Context::polygon>>,                                            //
    Group<GL_POLYGON_STIPPLE_BIT, Whole<&Context::polygon_stipple>>,                            //
    Group<GL_SCISSOR_BIT, Whole<&Context::scissor>>,                                            //
    Group<GL_STENCIL_BUFFER_BIT, Whole<&Context::stencil_buffer>>,                              //
    Group<GL_TEXTURE_BIT, SavedTextures>,                                                       //
    Group<GL_TRANSFORM_BIT, Whole<&Context::clip_plane>>,                                       //
    Group<GL_TEXTURE_BIT, Whole<&Context::tex_gen>>,                                            //
    Group<GL_TRANSFORM_BIT, Part<&Context::transform, &TransformState::mode>, 0>,               //
    Group<GL_TRANSFORM_BIT, Part<&Context::transform, &TransformState::normalize>>,             //
    Group<GL_VIEWPORT_BIT, Whole<&Context::viewport>>                                           //
    >;

}  // namespace halfspace::state
