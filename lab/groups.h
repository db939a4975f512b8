// Groups of cases with the guards that keep them, one file cases_*.cpp each.
#pragma once

#include "lab/case.h"
#include "lab/guards.h"

namespace farlight::lab {

struct Group {
    std::span<const Case> cases;
    std::span<const Guard> guards;
};

Group accumulation_group();
Group bsdf_group();
Group build_group();
Group counters_group();
Group display_group();
Group environment_group();
Group estimators_group();
Group filter_group();
Group garbage_group();
Group history_group();
Group holes_group();
Group insides_group();
Group laws_group();
Group light_group();
Group media_group();
Group mirrored_group();
Group motion_group();
Group normals_group();
Group origin_group();
Group packing_group();
Group poison_group();
Group precision_group();
Group random_group();
Group samplers_group();
Group scale_group();
Group server_group();
Group signals_group();
Group soak_group();
Group transport_group();
Group tree_group();
Group watertight_group();

inline std::vector<Group> all_groups()
{
    return {
        accumulation_group(),
        bsdf_group(),
        build_group(),
        counters_group(),
        display_group(),
        environment_group(),
        estimators_group(),
        filter_group(),
        garbage_group(),
        history_group(),
        holes_group(),
        insides_group(),
        laws_group(),
        light_group(),
        media_group(),
        mirrored_group(),
        motion_group(),
        normals_group(),
        origin_group(),
        packing_group(),
        poison_group(),
        precision_group(),
        random_group(),
        samplers_group(),
        scale_group(),
        server_group(),
        signals_group(),
        soak_group(),
        transport_group(),
        tree_group(),
        watertight_group(),
    };
}

}  // namespace farlight::lab
