/* Everything that the rest of the program needs for rendering: a device, and pictures of scenes by it. */
#ifndef KD_RENDER_RENDER_H
#define KD_RENDER_RENDER_H

#include "render/device/renderer.h"
#include "render/frame/frame.h"

#endif
