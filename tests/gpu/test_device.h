// A device with validation, a cache folder of its own, and GLSL from strings.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gpu/gpu.h"

namespace quincunx::gpu {

/// A folder under the system's temporary one that lives as long as the object.
struct TemporaryFolder {
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "quincunx-gpu-XXXXXX").string();
    if (mkdtemp(name.data())) path = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

/// Shader files in memory.
struct Files {
  std::map<std::string, std::string, std::less<>> texts;
  ShaderFiles lookup() const {
    return [this](std::string_view name) {
      const auto found = texts.find(name);
      return found == texts.end() ? std::string_view() : std::string_view(found->second);
    };
  }
};

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

/// Every test ends with the validation layer's silence, unless it takes the messages itself.
class GpuTest : public ::testing::Test {
 protected:
  void TearDown() override {
    if (!device) return;
    EXPECT_THAT(validation_messages(*device), ::testing::IsEmpty());
  }

  DeviceConfig config() const {
    DeviceConfig result;
    result.validation = true;
    result.cache_folder = folder.path.string();
    return result;
  }

  void open(Transfer transfer = Transfer::automatic) {
    DeviceConfig c = config();
    c.transfer = transfer;
    device = open_device(c);
  }

  /// A pipeline of one file, opening the device where that has not been done.
  Pipeline make(const std::string& glsl, std::vector<std::pair<std::string, std::uint32_t>> specialization = {}) {
    if (!device) open();
    const Files files{{{"test.comp", glsl}}};
    return create_pipeline(*device, compile(*device, files.lookup(), {"test.comp", {}}), specialization);
  }

  template <class T>
  Buffer filled(const std::vector<T>& values, BufferUse use = BufferUse::storage,
                VkFormat format = VK_FORMAT_UNDEFINED) {
    const Buffer buffer = create_buffer(*device, values.size() * sizeof(T), use, "test values", format);
    upload(*device, buffer, bytes_of(values));
    return buffer;
  }

  template <class T>
  std::vector<T> contents(const Buffer& buffer) {
    std::vector<T> values(buffer.bytes / sizeof(T));
    download(*device, buffer, std::as_writable_bytes(std::span(values)));
    return values;
  }

  TemporaryFolder folder;  // before the device, which writes there when it is closed
  std::shared_ptr<Device> device;
};

}  // namespace quincunx::gpu
