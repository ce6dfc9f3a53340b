"""PyOpenGL, which looks GL up through ctypes: a teapot and its reflection, kept inside the floor by the stencil buffer."""
import OpenGL

OpenGL.ERROR_CHECKING = False  # a recorder's own queries of later versions would be taken for errors of ours
from OpenGL.GL import *
from OpenGL.GLU import gluLookAt, gluPerspective
from OpenGL.GLUT import *

frame = 0


def floor():
    glBegin(GL_QUADS)
    glNormal3f(0, 1, 0)
    for x, z in ((-1.5, -1.5), (-1.5, 1.5), (1.5, 1.5), (1.5, -1.5)):
        glVertex3f(x, 0, z)
    glEnd()


def teapot():
    glPushMatrix()
    glLightfv(GL_LIGHT0, GL_POSITION, (2, 3, 2, 0))
    glRotatef(frame, 0, 1, 0)
    glTranslatef(0, 0.7, 0)
    glColor3f(0.9, 0.5, 0.2)
    glutSolidTeapot(0.7)
    glPopMatrix()


def display():
    global frame
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT)
    glMatrixMode(GL_PROJECTION)
    glLoadIdentity()
    gluPerspective(40, 1.5, 1, 20)
    glMatrixMode(GL_MODELVIEW)
    glLoadIdentity()
    gluLookAt(0, 2.2, 5, 0, 0.3, 0, 0, 1, 0)
    glColorMask(False, False, False, False)
    glDepthMask(False)
    glEnable(GL_STENCIL_TEST)
    glStencilFunc(GL_ALWAYS, 1, 255)
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE)
    floor()
    glColorMask(True, True, True, True)
    glDepthMask(True)
    glStencilFunc(GL_EQUAL, 1, 255)
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP)
    glPushMatrix()
    glScalef(1, -1, 1)
    glFrontFace(GL_CW)
    teapot()
    glFrontFace(GL_CCW)
    glPopMatrix()
    glDisable(GL_STENCIL_TEST)
    glEnable(GL_BLEND)
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA)
    glColor4f(0.2, 0.3, 0.5, 0.6)
    floor()
    glDisable(GL_BLEND)
    teapot()
    glutSwapBuffers()
    frame += 1
    glutPostRedisplay()


glutInit()
glutInitDisplayMode(GLUT_RGBA | GLUT_DOUBLE | GLUT_DEPTH | GLUT_STENCIL)
glutInitWindowSize(480, 320)
glutCreateWindow("PyOpenGL stencil")
glClearColor(0.75, 0.78, 0.8, 1)
for capability in (GL_DEPTH_TEST, GL_LIGHTING, GL_LIGHT0, GL_COLOR_MATERIAL, GL_NORMALIZE):
    glEnable(capability)
glutDisplayFunc(display)
glutMainLoop()
