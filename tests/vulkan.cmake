# Tests of vulkan.
