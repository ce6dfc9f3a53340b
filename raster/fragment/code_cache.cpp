// From lists of stages to kernels.
#include <algorithm>

#include "raster/fragment/program.h"

namespace halfspace::raster {
namespace {

// Covers the list from the front with the longest kernels there are. False if some stage has none of the wanted kind.
bool cover(const StageList& list, int first, int last, bool fuse, BlockFunction KernelPair::*kind,
           BlockProgram& program) {
  for (int at = first; at < last;) {
    int length = fuse ? last - at : 1;
    BlockFunction kernel = nullptr;
    for (; length >= 1; --length) {
      kernel = find_kernels(&list.ids[static_cast<size_t>(at)], length).*kind;
      if (kernel != nullptr) break;
    }
    if (kernel == nullptr) return false;
    program.stages[static_cast<size_t>(program.count)] = list.ids[static_cast<size_t>(at)];
    program.kernels[static_cast<size_t>(program.count++)] = kernel;
    at += length;
  }
  return program.count > 0;
}

// Whether all a list does is to store a colour that is the same for all of a primitive.
bool stores_one_value(const StageList& list) {
  using enum StageId;
  return list.count == 3 && (list.ids[0] == color_constant || list.ids[0] == color_flat) && list.ids[1] == round_rgba8 &&
         list.ids[2] == write_rgba8;
}

// Whether all a list does from its stage `first` on is to store a colour.
bool stores_color(const StageList& list, int first) {
  using enum StageId;
  if (list.count != first + 3) return false;
  const StageId* ids = &list.ids[static_cast<size_t>(first)];
  return (ids[0] == color_constant || ids[0] == color_affine_open) && ids[1] == round_rgba8 &&
         ids[2] == write_rgba8;
}

// Whether no stage looks at what was in memory.
bool overwrites(const StageList& list) {
  using enum StageId;
  const auto end = list.ids.begin() + list.count;
  return std::none_of(list.ids.begin(), end, [](StageId id) {
    return id < color_constant || id == alpha_test || id == blend_over_rgba8 || id == blend_rgba8 || id == write_rgba8_masked;
  });
}

// Puts the flat colour into the interpolated one's place; false if there is none.
bool take_flat_color(StageList& list) {
  for (StageId& id : list.ids) {
    if (id != StageId::color_affine && id != StageId::color_affine_open) continue;
    id = StageId::color_flat;
    return true;
  }
  return false;
}

// Takes the depth test off the list's front.
bool take_depth_test(StageList& list) {
  if (list.count == 0) return false;
  std::copy(list.ids.begin() + 1, list.ids.begin() + list.count, list.ids.begin());
  list.ids[static_cast<size_t>(--list.count)] = StageId{};
  return true;
}

// Whether each fragment that passes the depth test leaves its colour, in bytes, whatever was there.
bool covers(const CodeKey& key) {
  using enum StageId;
  StageList list = key.lists[0];
  if (!key.may_pack || (key.tests_depth && !take_depth_test(list)) || list.count == 0) return false;
  const auto end = list.ids.begin() + list.count;
  return end[-1] == write_rgba8 && overwrites(list) && std::find(list.ids.begin(), end, logic_op_rgba8) == end;
}

TileCode find_tile_code(const StageList& list) {
  if (list.count < 2) return {};
  const KernelPair kernels = find_kernels(list.ids.data(), list.count);
  TileCode code;
  code.tile = kernels.tile;
  code.block = kernels.block;
  code.fills = stores_one_value(list);
  code.overwrites = overwrites(list);
  BlockProgram rows;
  if (code.tile != nullptr || !cover(list, 0, list.count, true, &KernelPair::row, rows)) return code;
  if (rows.count > TileCode::kMaxKernels) return code;
  code.row_count = rows.count;
  std::copy(rows.kernels.begin(), rows.kernels.begin() + rows.count, code.row.begin());
  return code;
}

void find_group_kernels(const CodeKey& key, const StageList& list, BlockProgram& blocks) {
  const int first = key.tests_depth ? 1 : 0;
  if (list.count <= first) return;
  const BlockFunction depth = first != 0 ? find_kernels(list.ids.data(), first).groups : nullptr;
  if (first != 0 && depth == nullptr) return;
  blocks.groups = find_kernels(&list.ids[static_cast<size_t>(first)], list.count - first).groups;
  blocks.groups_depth = depth;
}

BlockProgram cover_blocks(const CodeKey& key, const StageList& list) {
  BlockProgram blocks;
  const bool fuses = key.fuse && !key.given_depth;
  BlockFunction KernelPair::*const kind = key.given_depth ? &KernelPair::given_depth : &KernelPair::block;
  if (key.both_planes) {
    cover(list, 0, list.tail, fuses, kind, blocks);
    blocks.head = blocks.count;
  }
  cover(list, key.both_planes ? list.tail : 0, list.count, fuses, kind, blocks);
  if (fuses && key.may_pack) find_group_kernels(key, list, blocks);
  if (key.both_planes || key.given_depth || !key.fuse) return blocks;
  blocks.whole = find_tile_code(list);
  StageList rest = list;
  if (key.accepts_nearer && take_depth_test(rest)) blocks.nearer = find_tile_code(rest);
  const bool goes_by_rows = blocks.nearer.row_count != 0 && blocks.whole.row_count == blocks.nearer.row_count + 1;
  blocks.defers = goes_by_rows && covers(key) && blocks.stages[1] == list.ids[1];
  return blocks;
}

ProgramCode find_code(const CodeKey& key) {
  ProgramCode code;
  for (unsigned variant = 0; variant < kVariantCount; ++variant)
    code.variants[variant] = cover_blocks(key, key.lists[variant]);
  StageList even = key.lists[kAffine];
  if (take_flat_color(even)) code.even = cover_blocks(key, even);
  constexpr StageId kStoring[] = {StageId::depth_always};
  code.stores_depth = find_kernels(kStoring, 1).tile;
  code.packs = key.may_pack;
  code.covers = covers(key);
  const bool lists_lines = key.fuse && !key.tests_depth;
  for (unsigned variant = 0; variant <= kAffine; ++variant) {
    const StageList& list = key.lists[variant];
    code.packs = code.packs && cover(list, key.tests_depth ? 1 : 0, list.count, key.fuse, &KernelPair::packed,
                                     code.packed[variant]);
    if (lists_lines) code.lines[variant] = find_kernels(list.ids.data(), list.count).lines;
  }
  code.stores_color = code.packs && key.fuse && stores_color(key.lists[kAffine], key.tests_depth ? 1 : 0);
  if (code.lines[0] == nullptr || code.lines[kAffine] == nullptr)
    code.lines[0] = code.lines[kAffine] = nullptr;
  return code;
}

}  // namespace

const ProgramCode& CodeCache::find(const CodeKey& key) {
  for (const Entry& entry : entries_)
    if (entry.filled && entry.key == key) return entry.code;
  Entry& entry = entries_[next_++ % entries_.size()];
  entry = {key, find_code(key), true};
  return entry.code;
}

}  // namespace halfspace::raster
