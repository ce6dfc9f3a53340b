// Names, binding, deletion and sharing of texture objects (spec 3.8.11), and what the unit samples.
#include <set>
#include <thread>
#include <vector>

#include "tests/unit/pixel_fixture.h"

namespace halfspace::state {
namespace {

class TextureObjectTest : public PixelTest {
 protected:
  GLuint bound(GLenum query = GL_TEXTURE_BINDING_2D) { return bound_in(gl(), query); }
  static GLuint bound_in(Context& context, GLenum query = GL_TEXTURE_BINDING_2D) {
    GLint name = -1;
    op::get_integerv(context, query, &name);
    return GLuint(name);
  }
  // One texel, no mipmaps: complete.
  static void define(Context& context, uint8_t red) {
    const uint8_t texel[4] = {red, 2, 3, 4};
    const GLint nearest = GL_NEAREST;
    op::tex_image_2d(context, GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
    op::tex_parameteriv(context, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, &nearest);
  }
  static int red_of(Context& context) {
    uint8_t texel[4] = {99, 99, 99, 99};
    op::get_tex_image(context, GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
    return texel[0];
  }
};

TEST_F(TextureObjectTest, GeneratedNamesAreFreshAndNotYetTextures) {
  op::bind_texture(gl(), GL_TEXTURE_2D, 2);  // taken before anything is generated
  std::vector<GLuint> names(100);
  op::gen_textures(gl(), 50, names.data());
  op::gen_textures(gl(), 50, names.data() + 50);
  const std::set<GLuint> unique(names.begin(), names.end());
  EXPECT_EQ(unique.size(), 100u);
  EXPECT_FALSE(unique.contains(0));
  EXPECT_FALSE(unique.contains(2));
  EXPECT_FALSE(op::is_texture(gl(), names[7]));
  op::bind_texture(gl(), GL_TEXTURE_2D, names[7]);
  EXPECT_TRUE(op::is_texture(gl(), names[7]));
  EXPECT_EQ(bound(), names[7]);
  EXPECT_FALSE(op::is_texture(gl(), 0));
  EXPECT_GL(GL_NO_ERROR);
}

TEST_F(TextureObjectTest, AnyNameMayBeBoundAndHasNoImage) {
  gl().texture.enabled_2d = true;
  define(gl(), 10);
  EXPECT_NE(current_texture_view(gl()), nullptr);
  op::bind_texture(gl(), GL_TEXTURE_2D, 0xFFFFFFFFu);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_TRUE(op::is_texture(gl(), 0xFFFFFFFFu));
  EXPECT_EQ(bound(), 0xFFFFFFFFu);
  EXPECT_EQ(current_texture_view(gl()), nullptr);
  op::bind_texture(gl(), GL_TEXTURE_2D, 0);
  EXPECT_NE(current_texture_view(gl()), nullptr);
}

TEST_F(TextureObjectTest, ATextureKeepsItsTarget) {
  op::bind_texture(gl(), GL_TEXTURE_1D, 5);
  op::bind_texture(gl(), GL_TEXTURE_2D, 5);
  EXPECT_GL(GL_INVALID_OPERATION);
  EXPECT_EQ(bound(), 0u);
  EXPECT_EQ(bound(GL_TEXTURE_BINDING_1D), 5u);
  op::bind_texture(gl(), GL_TEXTURE_3D, 6);
  EXPECT_GL(GL_INVALID_ENUM);
  EXPECT_FALSE(op::is_texture(gl(), 6));
}

TEST_F(TextureObjectTest, DeletingABoundTextureBindsTheDefault) {
  define(gl(), 1);
  op::bind_texture(gl(), GL_TEXTURE_2D, 9);
  define(gl(), 200);
  const GLuint names[] = {0, 9, 12345, 9};  // 0 and unused names are passed over
  op::delete_textures(gl(), 4, names);
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_EQ(bound(), 0u);
  EXPECT_FALSE(op::is_texture(gl(), 9));
  EXPECT_EQ(red_of(gl()), 1);
  op::bind_texture(gl(), GL_TEXTURE_2D, 9);  // a new one of that name
  EXPECT_EQ(red_of(gl()), 99);
}

TEST_F(TextureObjectTest, ADrawKeepsTheViewOfADeletedTexture) {
  gl().texture.enabled_2d = true;
  op::bind_texture(gl(), GL_TEXTURE_2D, 9);
  define(gl(), 200);
  const auto view = current_texture_view(gl());
  const GLuint name = 9;
  op::delete_textures(gl(), 1, &name);
  ASSERT_NE(view, nullptr);
  EXPECT_EQ(view->level_count, 1);
  EXPECT_NE(view->levels[0], nullptr);
  EXPECT_EQ(current_texture_view(gl()), nullptr);
}

TEST_F(TextureObjectTest, PrioritiesGoToTheTexturesThatExist) {
  const GLuint names[] = {3, 0, 77, 4};  // 77 is no texture
  const GLclampf priorities[] = {0.25f, 0.5f, 0.75f, 7};
  op::bind_texture(gl(), GL_TEXTURE_1D, 4);
  op::bind_texture(gl(), GL_TEXTURE_2D, 3);
  op::prioritize_textures(gl(), 4, names, priorities);
  EXPECT_GL(GL_NO_ERROR);
  const auto priority = [&](GLenum target) {
    GLfloat value = -1;
    op::get_tex_parameterfv(gl(), target, GL_TEXTURE_PRIORITY, &value);
    return value;
  };
  EXPECT_EQ(priority(GL_TEXTURE_2D), 0.25f);
  EXPECT_EQ(priority(GL_TEXTURE_1D), 1.0f);
  EXPECT_FALSE(op::is_texture(gl(), 77));
  op::bind_texture(gl(), GL_TEXTURE_2D, 0);
  EXPECT_EQ(priority(GL_TEXTURE_2D), 1.0f);  // name 0 is passed over
  const GLclampf half = 0.5f;
  op::prioritize_textures(gl(), -1, names, &half);
  EXPECT_GL(GL_INVALID_VALUE);
}

TEST_F(TextureObjectTest, TexturesAreResident) {
  op::bind_texture(gl(), GL_TEXTURE_2D, 3);
  op::bind_texture(gl(), GL_TEXTURE_1D, 4);
  GLuint reserved = 0;
  op::gen_textures(gl(), 1, &reserved);
  const GLuint names[] = {3, 4, 0}, unbound[] = {3, reserved};
  GLboolean residences[3] = {9, 9, 9};
  EXPECT_TRUE(op::are_textures_resident(gl(), 2, names, residences));
  EXPECT_GL(GL_NO_ERROR);
  EXPECT_FALSE(op::are_textures_resident(gl(), 3, names, residences));  // name 0
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_FALSE(op::are_textures_resident(gl(), 2, unbound, residences));
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_FALSE(op::are_textures_resident(gl(), -1, names, residences));
  EXPECT_GL(GL_INVALID_VALUE);
  for (GLboolean r : residences) EXPECT_EQ(r, 9);  // written only when some texture is not
}

TEST_F(TextureObjectTest, NegativeCountsAreRefused) {
  GLuint name = 77;
  op::gen_textures(gl(), -1, &name);
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_EQ(name, 77u);
  op::bind_texture(gl(), GL_TEXTURE_2D, 77);
  op::delete_textures(gl(), -1, &name);
  EXPECT_GL(GL_INVALID_VALUE);
  EXPECT_TRUE(op::is_texture(gl(), 77));
}

TEST_F(TextureObjectTest, TwoDimensionsWinOverOne) {
  define(gl(), 3);
  EXPECT_EQ(current_texture_view(gl()), nullptr);
  gl().texture.enabled_1d = true;
  EXPECT_EQ(current_texture_view(gl()), nullptr);  // the 1D texture has no image
  gl().texture.enabled_2d = true;
  EXPECT_NE(current_texture_view(gl()), nullptr);
}

TEST_F(TextureObjectTest, SharedByContextsExceptForNameZero) {
  Context other(gl().visual, &gl());
  Context stranger(gl().visual, nullptr);
  define(gl(), 11);
  op::bind_texture(gl(), GL_TEXTURE_2D, 4);
  define(gl(), 44);
  EXPECT_EQ(red_of(other), 99);
  op::bind_texture(other, GL_TEXTURE_2D, 4);
  op::bind_texture(stranger, GL_TEXTURE_2D, 4);
  EXPECT_EQ(red_of(other), 44);
  EXPECT_EQ(red_of(stranger), 99);
  GLuint mine[20], theirs[20];
  op::gen_textures(gl(), 20, mine);
  op::gen_textures(other, 20, theirs);
  std::set<GLuint> unique(mine, mine + 20);
  unique.insert(theirs, theirs + 20);
  EXPECT_EQ(unique.size(), 40u);
}

TEST_F(TextureObjectTest, ANameDeletedElsewhereStaysBoundHere) {
  Context other(gl().visual, &gl());
  op::bind_texture(gl(), GL_TEXTURE_2D, 4);
  define(gl(), 44);
  op::bind_texture(other, GL_TEXTURE_2D, 4);
  const GLuint name = 4;
  op::delete_textures(gl(), 1, &name);
  EXPECT_EQ(bound(), 0u);
  EXPECT_EQ(bound_in(other), 4u);
  EXPECT_EQ(red_of(other), 44);
  EXPECT_FALSE(op::is_texture(other, 4));
  op::bind_texture(other, GL_TEXTURE_2D, 4);  // the name is free: this makes another texture
  EXPECT_EQ(red_of(other), 99);
}

TEST_F(TextureObjectTest, ObjectsOutliveTheContextThatMadeThem) {
  auto first = std::make_unique<Context>(gl().visual, nullptr);
  Context second(gl().visual, first.get());
  op::bind_texture(*first, GL_TEXTURE_2D, 8);
  define(*first, 88);
  first.reset();
  op::bind_texture(second, GL_TEXTURE_2D, 8);
  EXPECT_EQ(red_of(second), 88);
}

TEST_F(TextureObjectTest, TheRevisionChangesWithWhateverASampleMayShow) {
  Context other(gl().visual, &gl());
  std::set<uint64_t> seen;
  const auto expect_new = [&](const char* what) {
    EXPECT_TRUE(seen.insert(texture_revision(gl())).second) << what;
  };
  expect_new("start");
  op::bind_texture(gl(), GL_TEXTURE_2D, 4);
  expect_new("bind");
  define(gl(), 1);
  expect_new("image and parameter");
  const uint8_t texel[4] = {5, 5, 5, 5};
  op::tex_sub_image_2d(gl(), GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texel);
  expect_new("sub-image");
  op::bind_texture(other, GL_TEXTURE_2D, 4);
  define(other, 2);
  expect_new("image from the other context");
  const GLint blend = GL_BLEND;
  op::tex_enviv(gl(), GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, &blend);
  expect_new("environment");
  op::bind_texture(gl(), GL_TEXTURE_2D, 0);
  expect_new("back to the default");
  const uint64_t before = texture_revision(gl());
  op::bind_texture(gl(), GL_TEXTURE_2D, 0);
  define(other, 3);  // bound there only
  EXPECT_EQ(texture_revision(gl()), before);
}

TEST_F(TextureObjectTest, AViewIsMadeOnceAndShowsChanges) {
  gl().texture.enabled_2d = true;
  define(gl(), 1);
  const auto first = current_texture_view(gl());
  EXPECT_EQ(current_texture_view(gl()), first);
  define(gl(), 2);
  const auto second = current_texture_view(gl());
  ASSERT_NE(second, nullptr);
  EXPECT_NE(second->levels[0], first->levels[0]);  // the old draw keeps its texels
  EXPECT_EQ(red_of(gl()), 2);
}

// Two threads, one name space: names stay unique and views whole while the texture is written to.
TEST_F(TextureObjectTest, ThreadsMayShare) {
  Context other(gl().visual, &gl());
  op::bind_texture(gl(), GL_TEXTURE_2D, 4);
  op::bind_texture(other, GL_TEXTURE_2D, 4);
  define(gl(), 1);
  gl().texture.enabled_2d = other.texture.enabled_2d = true;
  constexpr int kRounds = 300;
  std::vector<GLuint> mine(kRounds), theirs(kRounds);
  const auto work = [](Context& context, std::vector<GLuint>& names) {
    int missing = 0;
    for (int i = 0; i < kRounds; ++i) {
      op::gen_textures(context, 1, &names[size_t(i)]);
      define(context, uint8_t(i));
      missing += current_texture_view(context) == nullptr;
    }
    return missing;
  };
  int missing_there = -1;
  std::thread thread([&] { missing_there = work(other, theirs); });
  const int missing_here = work(gl(), mine);
  thread.join();
  EXPECT_EQ(missing_here, 0);
  EXPECT_EQ(missing_there, 0);
  std::set<GLuint> unique(mine.begin(), mine.end());
  unique.insert(theirs.begin(), theirs.end());
  EXPECT_EQ(unique.size(), size_t{2 * kRounds});
}

}  // namespace
}  // namespace halfspace::state
