#include "tests/bench/render/vtk_peers.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOpenGLGPUVolumeRayCastMapper.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShortArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <vtkAutoInit.h>

#include "tests/bench/render/synthetic_head.h"
VTK_MODULE_INIT(vtkRenderingOpenGL2);
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2);

namespace bench {

struct VtkPeer::Impl {
  vtkNew<vtkImageData> image;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkFlyingEdges3D> edges;
  glm::ivec2 px{0};
};

VtkPeer::VtkPeer(Kind kind, const assets::VolumeGrid& grid, std::span<std::int16_t> hounsfield, glm::ivec2 px)
    : impl_(std::make_unique<Impl>()) {
  Impl& vtk = *impl_;
  vtk.px = px;
  vtk.image->SetDimensions(grid.size.x, grid.size.y, grid.size.z);
  vtk.image->SetSpacing(grid.spacing_mm, grid.spacing_mm, grid.spacing_mm);
  vtk.image->SetOrigin(grid.origin_P_mm.x, grid.origin_P_mm.y, grid.origin_P_mm.z);
  vtkNew<vtkShortArray> values;
  values->SetArray(hounsfield.data(), static_cast<vtkIdType>(hounsfield.size()), 1);
  vtk.image->GetPointData()->SetScalars(values);
  vtk.window->SetOffScreenRendering(1);
  vtk.window->SetMultiSamples(0);
  vtk.window->SetSize(px.x, px.y);
  vtk.window->AddRenderer(vtk.renderer);
  vtk.renderer->SetBackground(0.1, 0.1, 0.15);

  if (kind == Kind::triangles) {
    vtk.edges->SetInputData(vtk.image);
    vtk.edges->SetValue(0, kSurface_HU);
    vtk.edges->ComputeNormalsOn();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(vtk.edges->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.95, 0.9, 0.75);
    actor->GetProperty()->SetSpecular(0.3);
    actor->GetProperty()->SetSpecularPower(20.0);
    vtk.renderer->AddActor(actor);
    return;
  }

  vtkNew<vtkVolumeProperty> property;
  vtkNew<vtkColorTransferFunction> colour;
  colour->AddRGBPoint(300.0, 0.8, 0.5, 0.4);
  colour->AddRGBPoint(900.0, 0.95, 0.9, 0.75);
  colour->AddRGBPoint(2600.0, 1.0, 1.0, 0.98);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(kSurface_HU, 0.0);
  opacity->AddPoint(kHalfway_HU, kHalfway);
  opacity->AddPoint(kOpaqueFrom_HU, kOpaque);
  property->SetColor(colour);
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(grid.spacing_mm);
  property->SetInterpolationTypeToLinear();
  property->ShadeOn();
  property->SetSpecular(0.3);
  property->SetSpecularPower(20.0);
  vtkNew<vtkVolume> volume;
  volume->SetProperty(property);
  if (kind == Kind::fixed_point) {
    vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
    mapper->SetInputData(vtk.image);
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetImageSampleDistance(1.0f);
    mapper->SetSampleDistance(static_cast<float>(0.5 * grid.spacing_mm));
    volume->SetMapper(mapper);
  } else {
    vtkNew<vtkOpenGLGPUVolumeRayCastMapper> mapper;
    mapper->SetInputData(vtk.image);
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetUseJittering(0);
    mapper->SetSampleDistance(static_cast<float>(0.5 * grid.spacing_mm));
    if (kind == Kind::gpu_iso) {
      mapper->SetBlendModeToIsoSurface();
      property->GetIsoSurfaceValues()->SetValue(0, kSurface_HU);
    }
    volume->SetMapper(mapper);
  }
  vtk.renderer->AddVolume(volume);
}

VtkPeer::~VtkPeer() = default;

void VtkPeer::edited() {
  impl_->image->GetPointData()->GetScalars()->Modified();
  impl_->image->Modified();
}

void VtkPeer::draw(const render::Camera& camera, double aside_mm) {
  const glm::dvec3 forward = glm::normalize(camera.look_at_P_mm - camera.eye_P_mm);
  const glm::dvec3 eye = camera.eye_P_mm + aside_mm * glm::normalize(glm::cross(forward, camera.up_P));
  vtkCamera* const vtk = impl_->renderer->GetActiveCamera();
  vtk->SetPosition(eye.x, eye.y, eye.z);
  vtk->SetFocalPoint(camera.look_at_P_mm.x, camera.look_at_P_mm.y, camera.look_at_P_mm.z);
  vtk->SetViewUp(camera.up_P.x, camera.up_P.y, camera.up_P.z);
  vtk->SetViewAngle(glm::degrees(camera.fov_y_rad));
  impl_->renderer->ResetCameraClippingRange();
  impl_->window->Render();
  unsigned char* const pixel = impl_->window->GetPixelData(0, 0, 0, 0, 0);
  delete[] pixel;
}

std::vector<std::uint8_t> VtkPeer::picture() {
  unsigned char* const all = impl_->window->GetPixelData(0, 0, impl_->px.x - 1, impl_->px.y - 1, 0);
  std::vector<std::uint8_t> rgb(all, all + static_cast<std::ptrdiff_t>(impl_->px.x) * impl_->px.y * 3);
  delete[] all;
  return rgb;
}

}  // namespace bench
