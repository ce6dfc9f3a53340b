#include "shrink.h"

#include <algorithm>

namespace halfspace::fuzz {
namespace {

// The stream without the calls [first, last), and without the Begin or End that would be left alone by that.
Stream without(const Stream& stream, size_t first, size_t last) {
  Stream rest(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(first));
  rest.insert(rest.end(), stream.begin() + static_cast<std::ptrdiff_t>(last), stream.end());
  return rest;
}

// The call that closes what `stream[at]` opens, or the size of the stream.
size_t closing(const Stream& stream, size_t at) {
  const Command wanted = stream[at].command == Command::glBegin     ? Command::glEnd
                         : stream[at].command == Command::glNewList ? Command::glEndList
                                                                    : stream[at].command;
  for (size_t i = at + 1; i < stream.size(); ++i) {
    if (stream[i].command == wanted) return i;
  }
  return stream.size();
}

class Shrinker {
 public:
  Shrinker(Stream stream, const std::function<bool(const Stream&)>& fails, int tries)
      : stream_(std::move(stream)), fails_(fails), tries_(tries) {}

  Stream run() {
    for (bool smaller = true; smaller && tries_ > 0;) {
      smaller = false;
      for (size_t run = std::max<size_t>(stream_.size() / 2, 1); run > 0; run /= 2) smaller |= drop_runs(run);
      smaller |= drop_blocks();
    }
    return stream_;
  }

 private:
  bool accept(Stream candidate) {
    if (tries_ <= 0 || !is_well_formed(candidate)) return false;
    --tries_;
    if (!fails_(candidate)) return false;
    stream_ = std::move(candidate);
    return true;
  }

  bool drop_runs(size_t run) {
    bool smaller = false;
    // From the end: what comes last depends on what is before, not the other way round.
    for (size_t end = stream_.size(); end > 0;) {
      const size_t first = end > run ? end - run : 0;
      smaller |= accept(without(stream_, first, end));
      end = std::min(first, stream_.size());
    }
    return smaller;
  }

  // Whole Begin/End and NewList/EndList blocks, then their brackets alone.
  bool drop_blocks() {
    bool smaller = false;
    for (size_t at = stream_.size(); at-- > 0;) {
      if (at >= stream_.size()) continue;
      if (stream_[at].command != Command::glBegin && stream_[at].command != Command::glNewList) continue;
      const size_t end = closing(stream_, at);
      if (end == stream_.size()) continue;
      if (accept(without(stream_, at, end + 1))) {
        smaller = true;
      } else if (accept(without(without(stream_, end, end + 1), at, at + 1))) {
        smaller = true;
      }
    }
    return smaller;
  }

  Stream stream_;
  const std::function<bool(const Stream&)>& fails_;
  int tries_;
};

}  // namespace

Stream shrink(const Stream& stream, const std::function<bool(const Stream&)>& fails, int most_tries) {
  return Shrinker(stream, fails, most_tries).run();
}

}  // namespace halfspace::fuzz
