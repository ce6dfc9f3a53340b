/* GL_HALFSPACE_accuracy: how exactly a context draws. docs/extensions/HALFSPACE_accuracy.txt is the specification. */
#ifndef GL_HALFSPACE_H
#define GL_HALFSPACE_H

#include <GL/gl.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef GL_HALFSPACE_accuracy
#define GL_HALFSPACE_accuracy 1
#define GL_ACCURACY_HALFSPACE 0x19190
#define GL_PERSPECTIVE_ACCURACY_HALFSPACE 0x19191
#define GL_INTERPOLATION_ACCURACY_HALFSPACE 0x19192
#define GL_FILTER_ACCURACY_HALFSPACE 0x19193
#define GL_LOD_ACCURACY_HALFSPACE 0x19194
#define GL_FOG_ACCURACY_HALFSPACE 0x19195
#define GL_POWER_ACCURACY_HALFSPACE 0x19196
#define GL_TRANSFORM_ACCURACY_HALFSPACE 0x19197
#define GL_COVERAGE_ACCURACY_HALFSPACE 0x19198
#define GL_DRAFT_HALFSPACE 0x191A0
#define GL_STANDARD_HALFSPACE 0x191A1
#define GL_EXACT_HALFSPACE 0x191A2
/* By glXGetProcAddress or OSMesaGetProcAddress; no library exports it. */
typedef void (APIENTRY *PFNGLACCURACYHALFSPACEPROC)(GLenum axis, GLenum level);
#endif

#ifdef __cplusplus
}
#endif

#endif
