#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "engine/gpu/device.h"

namespace mesher::test {

/// A test with a Vulkan device and the validation layer, including synchronization checks. Any
/// message fails the test, even during the destruction of the device.
class GpuTest : public ::testing::Test {
 protected:
  GpuTest()
      : instance_(std::make_unique<gpu::Instance>(gpu::InstanceOptions{.validation = true})),
        device_(std::make_unique<gpu::Device>(*instance_)) {}

  void TearDown() override {
    device_.reset();
    for (const std::string& message : instance_->messages().list())
      ADD_FAILURE() << message;
  }

  gpu::Instance& instance() { return *instance_; }
  gpu::Device& device() { return *device_; }

 private:
  std::unique_ptr<gpu::Instance> instance_;
  std::unique_ptr<gpu::Device> device_;
};

}  // namespace mesher::test
