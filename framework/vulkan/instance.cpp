#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "vulkan/structure.h"
#include "vulkan/support.h"

namespace voxray {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool hasLayer(std::string_view name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::ranges::any_of(layers, [&](const auto& layer) { return name == layer.layerName; });
}

bool hasInstanceExtension(std::string_view name) {
    uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::ranges::any_of(extensions, [&](const auto& e) { return name == e.extensionName; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    auto& log = *static_cast<ValidationLog*>(user);
    const std::lock_guard lock(log.mutex);
    log.messages.emplace_back(data->pMessage ? data->pMessage : "validation message without text");
    return VK_FALSE;
}

}  // namespace

Instance::Instance(bool validation) {
    if (validation && !hasLayer(kValidationLayer))
        throw Error("{} is not installed; install the package vulkan-validationlayers", kValidationLayer);
    debugUtils_ = hasInstanceExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME) || validation;

    auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "voxray";
    application.apiVersion = VK_API_VERSION_1_3;
    const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    auto create = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    create.pApplicationInfo = &application;
    create.enabledLayerCount = validation ? 1 : 0;
    create.ppEnabledLayerNames = &kValidationLayer;
    create.enabledExtensionCount = debugUtils_ ? uint32_t(extensions.size()) : 0;
    create.ppEnabledExtensionNames = extensions.data();
    const VkResult created = vkCreateInstance(&create, nullptr, &handle_);
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER) throw Error("{}", whyNoDevice({}));
    check(created, "vkCreateInstance");

    // Messages of the validation layer go to the log.
    if (!validation) return;
    auto messenger =
        structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    // No performance messages: they object to the layout GENERAL, which is intended.
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = collectMessage;
    messenger.pUserData = &log_;
    const auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(handle_, "vkCreateDebugUtilsMessengerEXT"));
    const VkResult result = createMessenger(handle_, &messenger, nullptr, &messenger_);
    if (result != VK_SUCCESS) {
        vkDestroyInstance(handle_, nullptr);
        check(result, "vkCreateDebugUtilsMessengerEXT");
    }
}

Instance::~Instance() {
    if (messenger_) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(handle_, messenger_, nullptr);
    }
    vkDestroyInstance(handle_, nullptr);
}

}  // namespace voxray
