# The GLX front end, relative to gl/. capture.cpp serves OSMesa too.
set(HALFSPACE_GLX_SOURCES
  capture.cpp
  )
