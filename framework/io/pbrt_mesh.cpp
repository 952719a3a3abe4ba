#include "io/pbrt_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {
namespace {

std::vector<glm::vec3> triples(const PbrtScanner& scanner, const PbrtParameter* parameter) {
    std::vector<glm::vec3> found;
    if (parameter != nullptr) {
        const std::vector<float>& values = parameter->numbers;
        if (values.size() % 3 != 0) {
            scanner.fail(parameter->at, "three numbers for each corner", std::to_string(values.size()));
        }
        for (std::size_t i = 0; i < values.size(); i += 3) {
            found.emplace_back(values[i], values[i + 1], values[i + 2]);
        }
    }
    return found;
}

void read_uvs(const PbrtScanner& scanner, const PbrtParameters& parameters, MeshData& mesh) {
    const PbrtParameter* uvs = parameters.find("uv");
    if (uvs == nullptr) {
        return;
    }
    if (uvs->numbers.size() != 2 * mesh.positions.size()) {
        scanner.fail(uvs->at, "two numbers for each corner", std::to_string(uvs->numbers.size()));
    }
    for (std::size_t i = 0; i < uvs->numbers.size(); i += 2) {
        mesh.uvs.emplace_back(uvs->numbers[i], uvs->numbers[i + 1]);
    }
}

void read_triangles(const PbrtScanner& scanner, const PbrtParameters& parameters, MeshData& mesh) {
    const PbrtParameter* indices = parameters.find("indices");
    if (indices == nullptr && mesh.positions.size() == 3) {
        mesh.triangles.push_back({0, 1, 2});
        return;
    }
    if (indices == nullptr || indices->numbers.empty() || indices->numbers.size() % 3 != 0) {
        scanner.fail(indices == nullptr ? parameters.directive() : indices->at,
                     "\"integer indices\", three for each triangle", "another number of them");
    }
    const std::vector<float>& numbers = indices->numbers;
    const auto is_corner = [&](float number) {
        return number >= 0.0F && number < static_cast<float>(mesh.positions.size()) && number == std::floor(number);
    };
    if (!std::all_of(numbers.begin(), numbers.end(), is_corner)) {
        scanner.fail(indices->at, "numbers of corners from 0 to " + std::to_string(mesh.positions.size() - 1),
                     "another number");
    }
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
        mesh.triangles.push_back({static_cast<std::uint32_t>(numbers[i]), static_cast<std::uint32_t>(numbers[i + 1]),
                                  static_cast<std::uint32_t>(numbers[i + 2])});
    }
}

}  // namespace

MeshData pbrt_mesh(const PbrtScanner& scanner, const PbrtParameters& parameters) {
    MeshData mesh;
    const PbrtParameter* positions = parameters.find("P");
    if (positions == nullptr) {
        scanner.fail(parameters.directive(), "\"point3 P\" of the mesh", "none");
    }
    mesh.positions = triples(scanner, positions);
    const PbrtParameter* normals = parameters.find("N");
    mesh.normals = triples(scanner, normals);
    if (normals != nullptr && mesh.normals.size() != mesh.positions.size()) {
        scanner.fail(normals->at, "as many normals as corners", std::to_string(mesh.normals.size()));
    }
    read_uvs(scanner, parameters, mesh);
    read_triangles(scanner, parameters, mesh);
    return mesh;
}

}  // namespace raysteps
