#include "gl/glx/choose.h"

#include <algorithm>
#include <array>
#include <optional>

namespace halfspace::gl::glx {
namespace {

constexpr int kDontCare = int(GLX_DONT_CARE);

enum class Match { at_least, exact, mask, ignored };

struct Rule {
  int attribute;
  Match match;
  int initial;  // what the list means when it does not say
};

// Table 3.4.
constexpr Rule kRules[] = {
    {GLX_FBCONFIG_ID, Match::exact, kDontCare},
    {GLX_BUFFER_SIZE, Match::at_least, 0},
    {GLX_LEVEL, Match::exact, 0},
    {GLX_DOUBLEBUFFER, Match::exact, kDontCare},
    {GLX_STEREO, Match::exact, False},
    {GLX_AUX_BUFFERS, Match::at_least, 0},
    {GLX_RED_SIZE, Match::at_least, 0},
    {GLX_GREEN_SIZE, Match::at_least, 0},
    {GLX_BLUE_SIZE, Match::at_least, 0},
    {GLX_ALPHA_SIZE, Match::at_least, 0},
    {GLX_DEPTH_SIZE, Match::at_least, 0},
    {GLX_STENCIL_SIZE, Match::at_least, 0},
    {GLX_ACCUM_RED_SIZE, Match::at_least, 0},
    {GLX_ACCUM_GREEN_SIZE, Match::at_least, 0},
    {GLX_ACCUM_BLUE_SIZE, Match::at_least, 0},
    {GLX_ACCUM_ALPHA_SIZE, Match::at_least, 0},
    {GLX_SAMPLE_BUFFERS, Match::at_least, 0},
    {GLX_SAMPLES, Match::at_least, 0},
    {GLX_RENDER_TYPE, Match::mask, GLX_RGBA_BIT},
    {GLX_DRAWABLE_TYPE, Match::mask, GLX_WINDOW_BIT},
    {GLX_X_RENDERABLE, Match::exact, kDontCare},
    {GLX_X_VISUAL_TYPE, Match::exact, kDontCare},
    {GLX_CONFIG_CAVEAT, Match::exact, kDontCare},
    {GLX_TRANSPARENT_TYPE, Match::exact, GLX_NONE},
    {GLX_TRANSPARENT_INDEX_VALUE, Match::exact, kDontCare},
    {GLX_TRANSPARENT_RED_VALUE, Match::exact, kDontCare},
    {GLX_TRANSPARENT_GREEN_VALUE, Match::exact, kDontCare},
    {GLX_TRANSPARENT_BLUE_VALUE, Match::exact, kDontCare},
    {GLX_TRANSPARENT_ALPHA_VALUE, Match::exact, kDontCare},
    {GLX_MAX_PBUFFER_WIDTH, Match::ignored, 0},
    {GLX_MAX_PBUFFER_HEIGHT, Match::ignored, 0},
    {GLX_MAX_PBUFFER_PIXELS, Match::ignored, 0},
    {GLX_VISUAL_ID, Match::ignored, 0},
};
constexpr size_t kRuleCount = std::size(kRules);

// The value asked for under each rule.
class Request {
 public:
  Request() {
    for (size_t i = 0; i < kRuleCount; ++i) values_[i] = kRules[i].initial;
  }
  // False for an attribute without a rule.
  bool set(int attribute, int value) {
    for (size_t i = 0; i < kRuleCount; ++i) {
      if (kRules[i].attribute != attribute) continue;
      values_[i] = value;
      return true;
    }
    return false;
  }
  int value(int attribute) const {
    for (size_t i = 0; i < kRuleCount; ++i) {
      if (kRules[i].attribute == attribute) return values_[i];
    }
    return 0;
  }
  bool accepts(const FbConfig& config) const;

 private:
  std::array<int, kRuleCount> values_{};
};

bool satisfies(const FbConfig& config, const Rule& rule, int wanted) {
  // GLX_LEVEL is the one attribute for which -1 is a value of its own.
  if (rule.match == Match::ignored || (wanted == kDontCare && rule.attribute != GLX_LEVEL)) return true;
  int has = 0;
  config_attribute(config, rule.attribute, &has);
  switch (rule.match) {
    case Match::at_least:
      return has >= wanted;
    case Match::mask:
      return (has & wanted) == wanted;
    default:
      return has == wanted;
  }
}

bool Request::accepts(const FbConfig& config) const {
  if (value(GLX_FBCONFIG_ID) != kDontCare) return config.id == value(GLX_FBCONFIG_ID);  // all else is ignored
  for (size_t i = 0; i < kRuleCount; ++i) {
    if (!satisfies(config, kRules[i], values_[i])) return false;
  }
  return true;
}

int attribute_of(const FbConfig& config, int attribute) {
  int value = 0;
  config_attribute(config, attribute, &value);
  return value;
}

// The sum of those components which the request names with more than 0 bits.
template <size_t N>
int requested_bits(const FbConfig& config, const Request& request, const int (&components)[N]) {
  int sum = 0;
  for (const int component : components) {
    const int wanted = request.value(component);
    if (wanted != 0 && wanted != kDontCare) sum += attribute_of(config, component);
  }
  return sum;
}

// Sort keys in the order of 3.3.3's list, smaller first. Caveat, stereo, samples and visual type are alike in
// all our configs; what is left equal keeps the order of the table.
std::array<int, 6> sort_key(const FbConfig& config, const Request& request) {
  constexpr int kColor[] = {GLX_RED_SIZE, GLX_GREEN_SIZE, GLX_BLUE_SIZE, GLX_ALPHA_SIZE};
  constexpr int kAccum[] = {GLX_ACCUM_RED_SIZE, GLX_ACCUM_GREEN_SIZE, GLX_ACCUM_BLUE_SIZE,
                            GLX_ACCUM_ALPHA_SIZE};
  return {-requested_bits(config, request, kColor), attribute_of(config, GLX_BUFFER_SIZE),
          attribute_of(config, GLX_DOUBLEBUFFER),   -attribute_of(config, GLX_DEPTH_SIZE),
          attribute_of(config, GLX_STENCIL_SIZE),   -requested_bits(config, request, kAccum)};
}

std::vector<const FbConfig*> best_first(std::span<const FbConfig> configs, const Request& request) {
  std::vector<const FbConfig*> chosen;
  for (const FbConfig& config : configs) {
    if (request.accepts(config)) chosen.push_back(&config);
  }
  std::stable_sort(chosen.begin(), chosen.end(), [&](const FbConfig* a, const FbConfig* b) {
    return sort_key(*a, request) < sort_key(*b, request);
  });
  return chosen;
}

// A glXChooseVisual list as a request. None when it asks for colour index, or for something unknown.
std::optional<Request> visual_request(const int* attributes) {
  Request request;
  request.set(GLX_DOUBLEBUFFER, False);
  bool rgba = false;
  for (const int* a = attributes; a && *a != None; ++a) {
    switch (*a) {
      case GLX_USE_GL:
        break;  // always so
      case GLX_RGBA:
        rgba = true;
        break;
      case GLX_DOUBLEBUFFER:
      case GLX_STEREO:
        request.set(*a, True);
        break;
      case GLX_BUFFER_SIZE:
        ++a;
        break;  // of colour-index visuals only
      default:
        if (!request.set(a[0], a[1])) return std::nullopt;
        ++a;
    }
  }
  if (!rgba) return std::nullopt;
  return request;
}

}  // namespace

std::vector<const FbConfig*> choose_configs(std::span<const FbConfig> configs, const int* attributes) {
  Request request;
  for (const int* a = attributes; a && *a != None; a += 2) {
    if (!request.set(a[0], a[1])) return {};
  }
  return best_first(configs, request);
}

const FbConfig* choose_visual(std::span<const FbConfig> configs, const int* attributes) {
  const std::optional<Request> request = visual_request(attributes);
  if (!request) return nullptr;
  const std::vector<const FbConfig*> chosen = best_first(configs, *request);
  return chosen.empty() ? nullptr : chosen.front();
}

}  // namespace halfspace::gl::glx
