// Embree's scene from packed triangles.
#include "lab/embree_oracle.h"

namespace farlight {
namespace {

RTCRay embree_ray(const TestRay& ray)
{
    RTCRay query{};
    query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
    query.tfar = ray.t_max;
    query.mask = ~0U;
    return query;
}

}  // namespace

EmbreeOracle::EmbreeOracle(const PackedScene& packed)
{
    const std::size_t count = packed.content.triangles;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    for (unsigned i = 0; i < 3 * count; ++i) {
        positions[i] = glm::uintBitsToFloat(glm::uvec3(packed.geometry.triangles[i]));
        indices[i] = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
}

EmbreeOracle::~EmbreeOracle()
{
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

RTCRayHit EmbreeOracle::closest(const TestRay& ray) const
{
    RTCRayHit query{};
    query.ray = embree_ray(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
    return query;
}

bool EmbreeOracle::any(const TestRay& ray) const
{
    RTCRay query = embree_ray(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0;
}

}  // namespace farlight
