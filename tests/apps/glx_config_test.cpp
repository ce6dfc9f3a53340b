// FBConfigs and visuals: what is offered, and which is chosen (GLX 1.4, 3.3.3).
#include <set>

#include "tests/apps/glx_fixture.h"

namespace halfspace::test {
namespace {

class GlxConfigTest : public GlxTest {
 protected:
  int get(GLXFBConfig config, int attribute) {
    int value = -12345;
    EXPECT_EQ(glXGetFBConfigAttrib(display_, config, attribute, &value), Success) << attribute;
    return value;
  }
  std::vector<GLXFBConfig> find(std::vector<int> attributes) {
    attributes.push_back(0);
    int count = -1;
    GLXFBConfig* found = glXChooseFBConfig(display_, screen_, attributes.data(), &count);
    std::vector<GLXFBConfig> result(found, found + count);
    if (found) XFree(found);
    return result;
  }
  std::vector<GLXFBConfig> all() {
    int count = 0;
    GLXFBConfig* found = glXGetFBConfigs(display_, screen_, &count);
    std::vector<GLXFBConfig> result(found, found + count);
    XFree(found);
    return result;
  }
};

TEST_F(GlxConfigTest, EveryConfigIsWhole) {
  const std::vector<GLXFBConfig> configs = all();
  ASSERT_GE(configs.size(), 4u);
  std::set<int> ids;
  for (const GLXFBConfig config : configs) {
    ids.insert(get(config, GLX_FBCONFIG_ID));
    EXPECT_EQ(get(config, GLX_RED_SIZE), 8);
    EXPECT_EQ(get(config, GLX_GREEN_SIZE), 8);
    EXPECT_EQ(get(config, GLX_BLUE_SIZE), 8);
    EXPECT_EQ(get(config, GLX_BUFFER_SIZE), 24 + get(config, GLX_ALPHA_SIZE));
    EXPECT_EQ(get(config, GLX_DEPTH_SIZE), 24);
    EXPECT_EQ(get(config, GLX_RENDER_TYPE), GLX_RGBA_BIT);
    EXPECT_EQ(get(config, GLX_DRAWABLE_TYPE), GLX_WINDOW_BIT | GLX_PIXMAP_BIT | GLX_PBUFFER_BIT);
    EXPECT_EQ(get(config, GLX_X_RENDERABLE), True);
    EXPECT_EQ(get(config, GLX_X_VISUAL_TYPE), GLX_TRUE_COLOR);
    XVisualInfo* visual = glXGetVisualFromFBConfig(display_, config);
    ASSERT_NE(visual, nullptr);
    EXPECT_EQ(int(visual->visualid), get(config, GLX_VISUAL_ID));
    int value = -1;
    EXPECT_EQ(glXGetConfig(display_, visual, GLX_USE_GL, &value), 0);
    EXPECT_EQ(value, True);
    EXPECT_EQ(glXGetConfig(display_, visual, GLX_DOUBLEBUFFER, &value), 0);
    EXPECT_EQ(value, get(config, GLX_DOUBLEBUFFER)) << "the visual remembers its config";
    EXPECT_EQ(glXGetConfig(display_, visual, GLX_ALPHA_SIZE, &value), 0);
    EXPECT_EQ(value, get(config, GLX_ALPHA_SIZE));
    EXPECT_EQ(glXGetConfig(display_, visual, 0x7777, &value), GLX_BAD_ATTRIBUTE);
    XFree(visual);
  }
  EXPECT_EQ(ids.size(), configs.size()) << "ids are unique";
}

TEST_F(GlxConfigTest, DefaultsMatchEverythingButTheirOrder) {
  const std::vector<GLXFBConfig> configs = find({});
  EXPECT_EQ(configs.size(), all().size());
  // Fewer bits, then single buffering come first.
  EXPECT_EQ(get(configs[0], GLX_DOUBLEBUFFER), False);
  EXPECT_EQ(get(configs[0], GLX_ALPHA_SIZE), 0);
  EXPECT_EQ(get(configs[0], GLX_VISUAL_ID), int(XVisualIDFromVisual(DefaultVisual(display_, screen_))));
  for (size_t i = 1; i < configs.size(); ++i) {
    const auto key = [&](GLXFBConfig c) {
      return std::pair(get(c, GLX_BUFFER_SIZE), get(c, GLX_DOUBLEBUFFER));
    };
    EXPECT_LE(key(configs[i - 1]), key(configs[i])) << i;
  }
}

TEST_F(GlxConfigTest, AskedForAlphaMoreComesFirst) {
  const std::vector<GLXFBConfig> configs = find({GLX_ALPHA_SIZE, 1, GLX_DOUBLEBUFFER, True});
  ASSERT_FALSE(configs.empty());
  for (const GLXFBConfig config : configs) EXPECT_EQ(get(config, GLX_ALPHA_SIZE), 8);
  const std::vector<GLXFBConfig> no_matter =
      find({GLX_ALPHA_SIZE, int(GLX_DONT_CARE), GLX_DOUBLEBUFFER, True});
  EXPECT_EQ(get(no_matter[0], GLX_ALPHA_SIZE), 0);
  EXPECT_GT(no_matter.size(), configs.size());
}

// One row a rule of table 3.4: a list, and whether anything of ours can match it.
TEST_F(GlxConfigTest, MatchingRules) {
  const struct {
    std::vector<int> list;
    bool matches;
  } rows[] = {
      {{GLX_RED_SIZE, 8}, true},
      {{GLX_RED_SIZE, 9}, false},
      {{GLX_BUFFER_SIZE, 32}, true},
      {{GLX_BUFFER_SIZE, 33}, false},
      {{GLX_DEPTH_SIZE, 24}, true},
      {{GLX_DEPTH_SIZE, 25}, false},
      {{GLX_DEPTH_SIZE, int(GLX_DONT_CARE)}, true},
      {{GLX_LEVEL, 0}, true},
      {{GLX_LEVEL, 1}, false},
      {{GLX_LEVEL, -1}, false},
      {{GLX_STEREO, True}, false},
      {{GLX_STEREO, int(GLX_DONT_CARE)}, true},
      {{GLX_AUX_BUFFERS, 1}, false},
      {{GLX_SAMPLE_BUFFERS, 0, GLX_SAMPLES, 0}, true},
      {{GLX_SAMPLE_BUFFERS, 1}, false},
      {{GLX_RENDER_TYPE, GLX_RGBA_BIT}, true},
      {{GLX_RENDER_TYPE, GLX_COLOR_INDEX_BIT}, false},
      {{GLX_RENDER_TYPE, GLX_RGBA_BIT | GLX_COLOR_INDEX_BIT}, false},
      {{GLX_RENDER_TYPE, int(GLX_DONT_CARE)}, true},
      {{GLX_DRAWABLE_TYPE, GLX_WINDOW_BIT | GLX_PBUFFER_BIT}, true},
      {{GLX_DRAWABLE_TYPE, 0x100}, false},
      {{GLX_X_RENDERABLE, True}, true},
      {{GLX_X_RENDERABLE, False}, false},
      {{GLX_X_VISUAL_TYPE, GLX_TRUE_COLOR}, true},
      {{GLX_X_VISUAL_TYPE, GLX_PSEUDO_COLOR}, false},
      {{GLX_CONFIG_CAVEAT, GLX_NONE}, true},
      {{GLX_CONFIG_CAVEAT, GLX_SLOW_CONFIG}, false},
      {{GLX_TRANSPARENT_TYPE, GLX_TRANSPARENT_RGB}, false},
      {{GLX_MAX_PBUFFER_WIDTH, 1 << 30}, true},  // ignored
      {{GLX_VISUAL_ID, 0x123456}, true},         // ignored
      {{0x7777, 1}, false},
  };
  for (const auto& row : rows)
    EXPECT_EQ(!find(row.list).empty(), row.matches)
        << "attribute " << std::hex << row.list[0] << ", " << row.list[1];
}

TEST_F(GlxConfigTest, AnIdAloneDecides) {
  for (const GLXFBConfig config : all()) {
    const std::vector<GLXFBConfig> found =
        find({GLX_FBCONFIG_ID, get(config, GLX_FBCONFIG_ID), GLX_RED_SIZE, 99, GLX_STEREO, True});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0], config);
  }
  EXPECT_TRUE(find({GLX_FBCONFIG_ID, 0x7ffffff}).empty());
}

TEST_F(GlxConfigTest, VisualsByBooleansThatStandAlone) {
  EXPECT_EQ(choose({}), nullptr) << "colour index";
  EXPECT_EQ(choose({GLX_RGBA, GLX_STEREO}), nullptr);
  EXPECT_EQ(choose({GLX_RGBA, GLX_DEPTH_SIZE, 32}), nullptr);
  EXPECT_EQ(choose({GLX_RGBA, 0x7777, 0}), nullptr);
  EXPECT_EQ(glXChooseVisual(display_, 99, nullptr), nullptr);
  const struct {
    std::vector<int> list;
    int double_buffered, alpha;
  } rows[] = {
      {{GLX_RGBA}, False, 0},
      {{GLX_RGBA, GLX_DOUBLEBUFFER}, True, 0},
      {{GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 24, GLX_RGBA}, True, 0},
      {{GLX_USE_GL, GLX_RGBA, GLX_ALPHA_SIZE, 1, GLX_BUFFER_SIZE, 99}, False, 8},
      {{GLX_RGBA, GLX_RED_SIZE, 1, GLX_ALPHA_SIZE, 0, GLX_DOUBLEBUFFER}, True, 0},
  };
  for (const auto& row : rows) {
    XVisualInfo* visual = choose(row.list);
    ASSERT_NE(visual, nullptr);
    EXPECT_EQ(visual->visual, DefaultVisual(display_, screen_));
    int double_buffered = -1, alpha = -1, rgba = 0;
    glXGetConfig(display_, visual, GLX_DOUBLEBUFFER, &double_buffered);
    glXGetConfig(display_, visual, GLX_ALPHA_SIZE, &alpha);
    glXGetConfig(display_, visual, GLX_RGBA, &rgba);
    EXPECT_EQ(double_buffered, row.double_buffered);
    EXPECT_EQ(alpha, row.alpha);
    EXPECT_TRUE(rgba);
    const XVisualInfo copy = *visual;  // what toolkits pass on
    XFree(visual);
    XVisualInfo mutable_copy = copy;
    glXGetConfig(display_, &mutable_copy, GLX_DOUBLEBUFFER, &double_buffered);
    EXPECT_EQ(double_buffered, row.double_buffered);
  }
}

TEST_F(GlxConfigTest, VisualsFoundByTheProgramItself) {
  int count = 0, usable = 0;
  XVisualInfo wanted{};
  wanted.screen = screen_;
  XVisualInfo* visuals = XGetVisualInfo(display_, VisualScreenMask, &wanted, &count);
  for (int i = 0; i < count; ++i) {
    int use_gl = -1, rgba = 0, depth = 0;
    ASSERT_EQ(glXGetConfig(display_, &visuals[i], GLX_USE_GL, &use_gl), 0);
    EXPECT_FALSE(use_gl && visuals[i].c_class != TrueColor);
    if (!use_gl) continue;
    ++usable;
    EXPECT_EQ(glXGetConfig(display_, &visuals[i], GLX_RGBA, &rgba), 0);
    EXPECT_EQ(glXGetConfig(display_, &visuals[i], GLX_DEPTH_SIZE, &depth), 0);
    EXPECT_TRUE(rgba);
    EXPECT_EQ(depth, 24);
    const GLXContext context = glXCreateContext(display_, &visuals[i], nullptr, True);
    EXPECT_NE(context, nullptr);
    glXDestroyContext(display_, context);
  }
  EXPECT_GT(usable, 0);
  XFree(visuals);
}

TEST_F(GlxConfigTest, ConfigsOutliveTheirArrayAndBadHandlesAreRefused) {
  const GLXFBConfig first = config({}), again = config({});
  EXPECT_EQ(first, again);
  int value = 0;
  int not_a_config = 0;
  const auto bad = reinterpret_cast<GLXFBConfig>(&not_a_config);
  EXPECT_NE(glXGetFBConfigAttrib(display_, bad, GLX_RED_SIZE, &value), Success);
  EXPECT_EQ(glXGetVisualFromFBConfig(display_, bad), nullptr);
  EXPECT_EQ(glXCreateNewContext(display_, bad, GLX_RGBA_TYPE, nullptr, True), nullptr);
  EXPECT_EQ(glXGetFBConfigAttrib(display_, first, 0x7777, &value), GLX_BAD_ATTRIBUTE);
}

TEST_F(GlxConfigTest, Versions) {
  int major = 0, minor = 0, base = -1;
  EXPECT_TRUE(glXQueryExtension(display_, &base, nullptr));
  EXPECT_TRUE(glXQueryVersion(display_, &major, &minor));
  EXPECT_EQ(major, 1);
  EXPECT_EQ(minor, 4);
  const std::string extensions = glXQueryExtensionsString(display_, screen_);
  EXPECT_EQ(extensions, glXGetClientString(display_, GLX_EXTENSIONS));
  EXPECT_STREQ(glXGetClientString(display_, GLX_VENDOR), "Halfspace");
  EXPECT_STREQ(glXQueryServerString(display_, screen_, GLX_VERSION), "1.4");
  EXPECT_EQ(glXGetClientString(display_, 0x7777), nullptr);
}

}  // namespace
}  // namespace halfspace::test
