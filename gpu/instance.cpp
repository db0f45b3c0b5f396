#include "gpu/instance.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "gpu/check.h"
#include "gpu/error.h"

namespace quincunx::gpu {
namespace {

constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto* instance = static_cast<Instance*>(user);
  const std::lock_guard lock(instance->mutex);
  instance->messages.emplace_back(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(Instance& instance) {
  VkDebugUtilsMessengerCreateInfoEXT info{};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not GENERAL: there the loader talks of other drivers on the machine.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = collect_message;
  info.pUserData = &instance;
  return info;
}

void require_validation_layer() {
  std::uint32_t count = 0;
  QUINCUNX_VK(vkEnumerateInstanceLayerProperties(&count, nullptr));
  std::vector<VkLayerProperties> layers(count);
  QUINCUNX_VK(vkEnumerateInstanceLayerProperties(&count, layers.data()));
  const bool found = std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, kLayer) == 0;
  });
  if (!found)
    throw DeviceError(std::string("validation was asked for, but ") + kLayer +
                      " is not installed (Debian package vulkan-validationlayers)");
}

void create_messenger(Instance& instance) {
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance.handle, "vkCreateDebugUtilsMessengerEXT"));
  if (!create) throw DeviceError("validation was asked for, but the instance has no VK_EXT_debug_utils");
  const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(instance);
  QUINCUNX_VK(create(instance.handle, &info, nullptr, &instance.messenger));
}

const char* type_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return "CPU";
    default: return "other";
  }
}

std::string driver_text(VkPhysicalDevice physical) {
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(physical, &properties);
  return std::string(driver.driverName) + (driver.driverInfo[0] ? " " : "") + driver.driverInfo;
}

std::uint64_t largest_device_heap(VkPhysicalDevice physical) {
  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  std::uint64_t largest = 0;
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const bool local = memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT;
    if (local) largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
  }
  return largest;
}

}  // namespace

Instance::~Instance() {
  if (messenger) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(handle, messenger, nullptr);
  }
  if (handle) vkDestroyInstance(handle, nullptr);
}

std::unique_ptr<Instance> create_instance(Validation validation) {
  auto instance = std::make_unique<Instance>();
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "quincunx";
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;

  const char* const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  // GPU-assisted: kernels are given checks of what they index, of descriptors and of device addresses.
  const VkValidationFeatureEnableEXT enables[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT, VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT,
                                                  VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT};
  VkValidationFeaturesEXT layer_features{};
  layer_features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  layer_features.enabledValidationFeatureCount = validation == Validation::gpu_assisted ? std::uint32_t(std::size(enables)) : 1;
  layer_features.pEnabledValidationFeatures = enables;
  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(*instance);
  messenger.pNext = &layer_features;
  if (validation != Validation::off) {
    require_validation_layer();
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &kLayer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = extensions;
    info.pNext = &messenger;
  }
  const VkResult result = vkCreateInstance(&info, nullptr, &instance->handle);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return nullptr;
  check(result, "vkCreateInstance");
  if (validation != Validation::off) create_messenger(*instance);
  return instance;
}

std::vector<VkPhysicalDevice> physical_devices(const Instance& instance) {
  std::uint32_t count = 0;
  const VkResult result = vkEnumeratePhysicalDevices(instance.handle, &count, nullptr);
  if (result == VK_ERROR_INITIALIZATION_FAILED) return {};  // what loaders say where every driver failed to start
  check(result, "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  if (count > 0) QUINCUNX_VK(vkEnumeratePhysicalDevices(instance.handle, &count, devices.data()));
  devices.resize(count);
  return devices;
}

std::optional<QueueFamily> compute_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  std::optional<QueueFamily> best;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool compute = families[i].queueFlags & VK_QUEUE_COMPUTE_BIT;
    if (!compute || families[i].timestampValidBits == 0) continue;
    const bool alone = !(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT);
    if (!best || alone) best = QueueFamily{i, families[i].timestampValidBits};
    if (alone) break;
  }
  return best;
}

DeviceInfo describe(VkPhysicalDevice physical, std::uint32_t index) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName;
  info.type = type_name(properties.deviceType);
  info.api_version = properties.apiVersion;
  info.memory_bytes = largest_device_heap(physical);
  info.max_storage_buffer_range = properties.limits.maxStorageBufferRange;
  info.max_texel_buffer_elements = properties.limits.maxTexelBufferElements;
  const bool modern = properties.apiVersion >= VK_API_VERSION_1_2;
  info.driver = modern ? driver_text(physical) : "unknown";
  info.usable = modern && compute_family(physical).has_value();
  return info;
}

}  // namespace quincunx::gpu
