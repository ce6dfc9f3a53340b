#include "state/pixel_store.h"

#include <array>
#include <cmath>
#include <utility>

#include "state/context.h"
#include "state/get.h"
#include "state/operations.gen.h"

namespace halfspace::state {
namespace {

struct StoreParameter {
  GLenum name;
  PixelStore PixelStoreState::*store;
  bool PixelStore::*flag;  // null: `number`
  GLint PixelStore::*number;
};

constexpr auto kPack = &PixelStoreState::pack, kUnpack = &PixelStoreState::unpack;
constexpr StoreParameter kParameters[] = {
    {GL_PACK_SWAP_BYTES, kPack, &PixelStore::swap_bytes, nullptr},
    {GL_PACK_LSB_FIRST, kPack, &PixelStore::lsb_first, nullptr},
    {GL_PACK_ROW_LENGTH, kPack, nullptr, &PixelStore::row_length},
    {GL_PACK_SKIP_ROWS, kPack, nullptr, &PixelStore::skip_rows},
    {GL_PACK_SKIP_PIXELS, kPack, nullptr, &PixelStore::skip_pixels},
    {GL_PACK_ALIGNMENT, kPack, nullptr, &PixelStore::alignment},
    {GL_UNPACK_SWAP_BYTES, kUnpack, &PixelStore::swap_bytes, nullptr},
    {GL_UNPACK_LSB_FIRST, kUnpack, &PixelStore::lsb_first, nullptr},
    {GL_UNPACK_ROW_LENGTH, kUnpack, nullptr, &PixelStore::row_length},
    {GL_UNPACK_SKIP_ROWS, kUnpack, nullptr, &PixelStore::skip_rows},
    {GL_UNPACK_SKIP_PIXELS, kUnpack, nullptr, &PixelStore::skip_pixels},
    {GL_UNPACK_ALIGNMENT, kUnpack, nullptr, &PixelStore::alignment},
};

const StoreParameter* find_parameter(GLenum name) {
  for (const StoreParameter& parameter : kParameters) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

// Spec table 3.1: alignment 1, 2, 4 or 8; the others any integer from 0.
bool in_range(const StoreParameter& parameter, GLint value) {
  if (parameter.number == &PixelStore::alignment) {
    return value == 1 || value == 2 || value == 4 || value == 8;
  }
  return value >= 0;
}

void set_number(Context& context, const StoreParameter& parameter, GLint value) {
  if (!in_range(parameter, value)) return record_error(context, GL_INVALID_VALUE, "glPixelStore");
  context.pixel_store.*parameter.store.*parameter.number = value;
}

template <size_t kIndex>
void read_parameter(const Context& context, double* out) {
  constexpr StoreParameter kParameter = kParameters[kIndex];
  const PixelStore& store = context.pixel_store.*kParameter.store;
  if constexpr (kParameter.flag != nullptr) {
    out[0] = store.*kParameter.flag ? 1 : 0;
  } else {
    out[0] = store.*kParameter.number;
  }
}

constexpr GetKind kind_of(const StoreParameter& parameter) {
  return parameter.number == nullptr ? GetKind::boolean : GetKind::integer;
}

template <size_t... kIndex>
constexpr auto make_rows(std::index_sequence<kIndex...>) {
  return std::array{
      GetRow{kParameters[kIndex].name, kind_of(kParameters[kIndex]), 1, read_parameter<kIndex>}...};
}

constexpr auto kGetRows = make_rows(std::make_index_sequence<std::size(kParameters)>{});

}  // namespace

std::span<const GetRow> pixel_store_get_rows() { return kGetRows; }

ClientLayout client_layout(const PixelStore& store, GLsizei width, size_t pixel_bytes) {
  const size_t row_pixels = size_t(store.row_length > 0 ? store.row_length : width);
  const size_t alignment = size_t(store.alignment);
  ClientLayout layout;
  layout.pixel_bytes = pixel_bytes;
  // The spec rounds up only when an element is smaller than the alignment; else nothing is left to round.
  layout.row_bytes = (row_pixels * pixel_bytes + alignment - 1) / alignment * alignment;
  layout.offset = size_t(store.skip_rows) * layout.row_bytes + size_t(store.skip_pixels) * pixel_bytes;
  return layout;
}

namespace op {

void pixel_storei(Context& context, GLenum pname, GLint param) {
  const StoreParameter* parameter = find_parameter(pname);
  if (parameter == nullptr) return record_error(context, GL_INVALID_ENUM);
  if (parameter->flag != nullptr) {
    context.pixel_store.*parameter->store.*parameter->flag = param != 0;
  } else {
    set_number(context, *parameter, param);
  }
}

void pixel_storef(Context& context, GLenum pname, GLfloat param) {
  const StoreParameter* parameter = find_parameter(pname);
  if (parameter == nullptr) return record_error(context, GL_INVALID_ENUM);
  if (parameter->flag != nullptr) {
    context.pixel_store.*parameter->store.*parameter->flag = param != 0;
  } else {
    // To the nearest integer (spec 3.6.1); what no GLint holds is out of every range.
    const double rounded = std::floor(double(param) + 0.5);
    set_number(context, *parameter, rounded >= 0 && rounded <= 0x7FFFFFFF ? GLint(rounded) : -1);
  }
}

}  // namespace op
}  // namespace halfspace::state
