// From a draw's state to the list of stages its fragments go through.
#pragma once

#include <array>
#include <cstdint>

#include "raster/fragment/block.h"
#include "raster/isa.h"
#include "raster/primitive/segment.h"

namespace halfspace::raster {

enum class StageId : uint8_t {
#define STAGE(id, body, reads, writes) id,
#include "raster/fragment/stages.def"
#undef STAGE
  count
};

inline constexpr int kMaxStages = 14;

// The stages in the order they run. Two equal lists compute the same thing with the same code.
struct StageList {
  std::array<StageId, kMaxStages> ids{};
  int count = 0;
  int tail = 0;  // the first stage that touches colour memory
  void add(StageId id) { ids[static_cast<size_t>(count++)] = id; }
  bool operator==(const StageList&) const = default;
};

// A list of stages for whole blocks of a tile: as one kernel, as several that take a row of the tile's blocks in turn, or
// not at all.
struct TileCode {
  static constexpr int kMaxKernels = 8;
  BlockFunction tile = nullptr;   // on BlockContext::blocks
  std::array<BlockFunction, kMaxKernels> row{};
  int row_count = 0;
  bool exists() const { return tile != nullptr || row_count != 0; }
  BlockFunction block = nullptr;  // the same on one block
  bool fills = false;             // it stores the same pixel value everywhere, whatever was there
  bool overwrites = false;        // what its pixels were before does not matter
};

// A stage list as kernels to call one after another; each does one or several stages.
struct BlockProgram {
  std::array<BlockFunction, kMaxStages> kernels{};
  std::array<StageId, kMaxStages> stages{};  // the first, or only, stage of each kernel
  int count = 0;
  TileCode whole;   // all of it
  TileCode nearer;  // all but the depth test it begins with
  // All after the depth test may run later, on whatever pixels nothing has been drawn over meanwhile.
  bool defers = false;
  // All of it on groups of a tile (BlockContext::groups): a depth test, or null, and the rest. Null: there are none such.
  BlockFunction groups_depth = nullptr, groups = nullptr;
  int head = 0;  // kernels before the first that touches colour memory, where there are two planes to do that to
  void run(BlockContext& block) const { run(block, 0, count); }
  void run_head(BlockContext& block) const { run(block, 0, head); }
  void run_tail(BlockContext& block) const { run(block, head, count); }
  void run_depth(BlockContext& block) const { run(block, 0, 1); }
  void run_deferred(BlockContext& block) const { run(block, 1, count); }
  // On the queue's fragments, none of which is lost on the way.
  void run_packed(BlockContext& block) const {
    for (int i = 0; i < count; ++i) {
      if (block.meter != nullptr)
        run_metered(block, i, static_cast<uint64_t>(block.queue->count));
      else
        kernels[static_cast<size_t>(i)](block);
    }
  }

 private:
  void run(BlockContext& block, int first, int last) const {
    for (int i = first; i < last && block.live != 0; ++i) {
      if (block.meter != nullptr)
        run_metered(block, i, static_cast<uint64_t>(__builtin_popcountll(block.live)));
      else
        kernels[static_cast<size_t>(i)](block);
    }
  }
  void run_metered(BlockContext& block, int kernel, uint64_t fragments) const;
};

struct ProgramCode {
  BlockProgram variants[kVariantCount];
  // Variant kAffine for primitives that have one colour all over, though the draw's colours differ. Empty: none.
  BlockProgram even;
  // Small triangles: depth test first, then these on packed fragments. [0] perspective, [kAffine] affine, in float.
  BlockProgram packed[2];
  // What `packed` does, as one kernel for packets of lines (BlockContext::lines). Null: there is none.
  BlockFunction lines[2] = {};
  bool packs = false;
  // All that `packed` does to fragments that are affine is to round their colour and to store it.
  bool stores_color = false;
  bool covers = false;  // whatever was there, a fragment that passes the depth test leaves its colour
  BlockFunction stores_depth = nullptr;  // on whole blocks of a tile, the depth and nothing else
};

// All that decides the code. What is not there are values, which often change from draw to draw.
struct CodeKey {
  StageList lists[kVariantCount];
  Isa isa{};
  bool fuse = false, both_planes = false, given_depth = false;
  bool may_pack = false;    // nothing forbids it but what its stages are
  bool tests_depth = false;  // by the lists' first stage
  bool accepts_nearer = false;  // that stage does no more than to let nearer fragments through
  bool operator==(const CodeKey&) const = default;
};

// The code that was found last, since to find it takes longer than to shade a few pixels.
class CodeCache {
 public:
  const ProgramCode& find(const CodeKey& key);

 private:
  struct Entry {
    CodeKey key;
    ProgramCode code;
    bool filled = false;
  };
  std::array<Entry, 4> entries_;
  size_t next_ = 0;
};

struct PipelineProgram : ProgramCode {
  DepthState depth;  // the test that packing does; test == false: none
  FragmentParams params;
  bool reads_depth = false, writes_depth = false, writes_color = false;
  bool reads_stencil = false;
  int plane = 0;  // index of the colour plane drawn to; with `both_planes` the other one is, too
  bool both_planes = false;
  bool rejects_deeper = false;  // depth test is LESS or LEQUAL and runs first: coarse z may drop a block
  bool accepts_nearer = false;  // and it lets a fragment through that is nearer, whatever else the fragment is
  bool depth_may_grow = false;  // the depth function can store a larger value
  bool depth_pass_lowers = false;  // every pixel of a full block ends at or before the primitive
  bool draws_nothing = false;
  // As the state has them. Tiles look here: few programs stay in the cache where many draws' states do not.
  bool flat_shading = false, stippled = false;
};

// Which stages the state calls for, drawing on its colour targets. `variant`: bits of Variant.
StageList list_stages(const DrawState& state, const VertexLayout& layout, ColorFormat format, unsigned variant);

// Whether programs for these two, with the same layout and format, are the same: whatever build_program() reads.
bool have_same_program(const DrawState& a, const DrawState& b);

// fuse: false runs every stage alone.
void build_program(const DrawState& state, const VertexLayout& layout, ColorFormat format, bool fuse, CodeCache& cache,
                   PipelineProgram& program);

// Per-ISA code of `count` stages in a row: of one stage, or of a run listed in raster/fragment/fused.def, else null.
// `block` works on the rows of a block, `packed` on packed fragments (null where that cannot be).
struct KernelPair {
  BlockFunction block = nullptr, packed = nullptr;
  BlockFunction given_depth = nullptr;  // of one stage only: where fragments bring their own depth
  BlockFunction tile = nullptr;         // of a whole list: on whole blocks of a tile
  BlockFunction row = nullptr;          // on whole blocks of a row of a tile
  BlockFunction lines = nullptr;        // of a whole list: on packets of lines
  BlockFunction groups = nullptr;       // of a depth test, or of a whole list after it: on groups of a tile
};
KernelPair find_kernels(const StageId* ids, int count);

}  // namespace halfspace::raster
