# The GLX front end, relative to gl/. capture.cpp serves OSMesa too.
set(HALFSPACE_GLX_SOURCES
  capture.cpp
  glx/api_config.cpp
  glx/api_context.cpp
  glx/api_drawable.cpp
  glx/api_query.cpp
  glx/api_swap.cpp
  glx/choose.cpp
  glx/connection.cpp
  glx/copy_pixels.cpp
  glx/current.cpp
  glx/drawable.cpp
  glx/fb_config.cpp
  glx/present.cpp
  glx/registry.cpp
  glx/x_font.cpp)
