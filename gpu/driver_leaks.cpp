// Linked into every sanitized program that uses a device: tells LeakSanitizer which leaks are the driver's, not ours.
//
// The loader unloads drivers and layers with the last instance, and a leak in an unloaded library has no name by which
// it could be told from ours. So nothing is unloaded, and what these libraries leak is named.
extern "C" {

int dlclose(void*) { return 0; }

const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp\n"       // Mesa's lavapipe
         "leak:libVkLayer_khronos\n";  // the validation layer
}

}  // extern "C"
