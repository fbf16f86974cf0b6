// A plug-in that links the libraries: makes a device and a face, draws, and lets both go.

#include "drawing.h"
#include "runtime/files/face_file.h"

extern "C" bool draws() {
    if (blush::load_face("there is no such file.glb")) return false;
    const blush::Result<blush::Device> device = blush::Device::headless();
    return device && draw_pyramid(*device);
}
