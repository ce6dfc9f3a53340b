// The list between glNewList and glEndList. Commands become steps; vertices between Begin and End are
// gathered, and become one step that is ready to draw.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "state/current.h"
#include "state/gl_types.h"
#include "state/list_batch.h"

namespace halfspace::state {

struct DisplayList;
struct ListNode;

class ListCompiler {
 public:
  ListCompiler();
  ~ListCompiler();

  bool active() const { return name != 0; }
  bool executes() const { return mode == GL_COMPILE_AND_EXECUTE; }

  void start(GLuint list_name, GLenum list_mode);
  // The finished list, or null when memory ran out. The compiler is inactive afterwards.
  std::shared_ptr<DisplayList> finish();
  void abandon();

  // Every command that is not gathered goes through this first: what was gathered becomes a step before it.
  void settle();
  void append(ListNode* node);

  // Gathered commands. Each returns false where it has to become a step of its own.
  bool begin(GLenum primitive);
  bool end();
  bool vertex(const float xyzw[4]);
  bool set_attribute(ListAttribute attribute, const float* value);
  bool material(GLenum face, GLenum pname, const float* params, size_t count);

  // A step of its own: vertices of glDrawArrays and glDrawElements, which leave the current values alone.
  void add_arrays(const ListBatchBuilder& arrays);

  GLuint name = 0;
  GLenum mode = 0;
  std::unique_ptr<DisplayList> list;
  bool failed = false;  // out of memory; the rest of the list is not kept

 private:
  // passing: vertices are steps of their own, for what surrounds them is not known before the list is played.
  enum class Phase : uint8_t { outside, gathering, passing };

  bool joins(GLenum primitive) const;
  ListBatch& append_batch(const ListBatchBuilder& builder, const ListValues& last);
  void append_pairs(bool unfinished);
  void flush();               // the closed pairs become a step
  void flush_closed_pairs();  // leaving the open one
  void flush_unfinished();    // the open one too, as a step that is replayed call by call
  void reset_batch();

  Phase phase_ = Phase::outside;
  // Attributes set since the last step, and their values.
  ListValues values_, values_at_begin_;
  ListBatchBuilder batch_;
};

}  // namespace halfspace::state
