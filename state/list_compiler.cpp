#include "state/list_compiler.h"

#include <algorithm>
#include <utility>

#include "state/derive/derived.h"
#include "state/display_list.h"

namespace halfspace::state {
namespace {

struct BatchNode : ListNode {
  ListBatch batch;
};

void play_batch_node(Context& context, const ListNode& node) {
  play_batch(context, static_cast<const BatchNode&>(node).batch);
}

// Attributes set with no vertices to go with.
struct ValuesNode : ListNode {
  ListValues values;
};

void play_values_node(Context& context, const ListNode& node) {
  play_values(context, static_cast<const ValuesNode&>(node).values);
}

}  // namespace

ListCompiler::ListCompiler() = default;
ListCompiler::~ListCompiler() = default;

void ListCompiler::start(GLuint list_name, GLenum list_mode) {
  list = std::make_unique<DisplayList>();
  name = list_name;
  mode = list_mode;
  failed = false;
  phase_ = Phase::outside;
  values_.known = 0;
  reset_batch();
}

std::shared_ptr<DisplayList> ListCompiler::finish() {
  std::shared_ptr<DisplayList> finished;
  if (!failed) {
    settle();
    finished = std::move(list);
  }
  abandon();
  return finished;
}

void ListCompiler::abandon() {
  list.reset();
  batch_ = {};  // its memory too
  name = mode = 0;
}

void ListCompiler::append(ListNode* node) {
  *list->tail = node;
  list->tail = &node->next;
}

void ListCompiler::settle() {
  if (phase_ == Phase::gathering) {
    flush_unfinished();
    phase_ = Phase::passing;
  } else {
    flush();
  }
}

ListBatch& ListCompiler::append_batch(const ListBatchBuilder& builder, const ListValues& last) {
  BatchNode* node = list->memory.make<BatchNode>();
  node->play = play_batch_node;
  node->batch = store_batch(list->memory, builder, last);
  append(node);
  return node->batch;
}

void ListCompiler::append_pairs(bool unfinished) {
  append_batch(batch_, values_).unfinished = unfinished;
  values_.known = 0;
  reset_batch();
}

void ListCompiler::add_arrays(const ListBatchBuilder& arrays) {
  settle();
  append_batch(arrays, {}).from_arrays = true;
}

void ListCompiler::flush() {
  if (!batch_.pairs.empty()) return append_pairs(false);
  if (values_.known == 0) return;
  ValuesNode* node = list->memory.make<ValuesNode>();
  node->play = play_values_node;
  node->values = std::exchange(values_, {});
  append(node);
}

void ListCompiler::flush_closed_pairs() {
  ListBatchBuilder open = batch_.split_last_pair();
  const ListValues values = std::exchange(values_, values_at_begin_);
  flush();
  values_ = values;
  batch_ = std::move(open);
}

void ListCompiler::flush_unfinished() {
  if (batch_.pairs.size() > 1) flush_closed_pairs();
  append_pairs(true);
}

void ListCompiler::reset_batch() {
  batch_.truncate(0);
  batch_.materials.clear();
  batch_.pairs.clear();
}

bool ListCompiler::joins(GLenum primitive) const {
  if (batch_.pairs.empty() || batch_.mode != primitive || !raster::separate_vertices(primitive_of(primitive)))
    return false;
  if (!batch_.materials.empty()) return false;
  for (size_t a = 0; a < kListColumns; ++a) {
    if (values_.knows(a) && batch_.columns[a].data.empty()) return false;
  }
  return true;
}

bool ListCompiler::begin(GLenum primitive) {
  if (phase_ != Phase::outside || primitive > GL_POLYGON) return false;
  // Attributes set since the last step belong to the pair; after another pair, they are its last values as
  // well.
  if (!batch_.pairs.empty() && !joins(primitive)) flush();
  batch_.mode = primitive;
  batch_.pairs.push_back(batch_.count);
  values_at_begin_ = values_;
  phase_ = Phase::gathering;
  return true;
}

bool ListCompiler::end() {
  const Phase phase = std::exchange(phase_, Phase::outside);
  if (phase != Phase::gathering) return false;
  // An unfinished primitive is dropped (spec 2.6.1).
  if (const uint32_t n = raster::separate_vertices(primitive_of(batch_.mode)))
    batch_.truncate(batch_.count - batch_.count % n);
  return true;
}

bool ListCompiler::vertex(const float xyzw[4]) {
  if (phase_ != Phase::gathering) return false;
  batch_.add_vertex(xyzw, values_);
  return true;
}

bool ListCompiler::set_attribute(ListAttribute attribute, const float* value) {
  if (phase_ == Phase::passing) return false;
  values_.known = uint8_t(values_.known | 1u << attribute);
  std::copy_n(value, kListAttributeSize[attribute], values_.value[attribute].begin());
  return true;
}

bool ListCompiler::material(GLenum face, GLenum pname, const float* params, size_t count) {
  if (phase_ != Phase::gathering) return false;
  if (batch_.pairs.size() > 1) flush_closed_pairs();
  ListMaterial& m = batch_.materials.emplace_back(ListMaterial{batch_.count, face, pname, {}});
  std::copy_n(params, std::min<size_t>(count, 4), m.params.begin());
  return true;
}

}  // namespace halfspace::state
