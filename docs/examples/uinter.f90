! UINTER for Abaqus/Standard: the contact law of the model as a surface interaction, with wear
! and roughness as state variables of each contact point. Put the generated file before it:
!
!   derive code rigid_bearing --target fortran -o wear_model.f90
!   cat wear_model.f90 uinter.f90 > user.f90
!
! *SURFACE INTERACTION, NAME=..., USER, DEPVAR=2, PROPERTIES=7
!   p_max, h_0, sigma_c0, K_c, H_c, f_c, slip_rate
!
! Wear opens the gap by itself: the mesh is not moved (for that see umeshmotion.f90).
subroutine uinter(stress, ddsddr, dviscous, dstructural, flux, ddfddt, ddsddt, ddfddr, statev, &
    sed, sfd, spd, svd, scd, pnewdt, rdisp, drdisp, temp, dtemp, predef, dpred, time, dtime, &
    freqr, ciname, secname, mainname, props, coords, alocaldir, drot, area, chrlngth, node, &
    ndir, nstatv, npred, nprops, mcrd, kstep, kinc, kit, linper, lopenclose, lstate, lsdi, lprint)
  use, intrinsic :: iso_fortran_env, only: dp => real64
  use wear_tanh_rigid_bearing, only: contact_pressure
  implicit none
  integer, intent(in) :: node, ndir, nstatv, npred, nprops, mcrd, kstep, kinc, kit, linper, lprint
  integer, intent(inout) :: lopenclose, lstate, lsdi
  real(dp), intent(inout) :: stress(ndir), ddsddr(ndir, ndir), dviscous(ndir, ndir), &
    dstructural(ndir, ndir), flux(2), ddfddt(2, 2), ddsddt(ndir, 2), ddfddr(2, ndir), &
    statev(nstatv), sed, sfd, spd, svd, scd, pnewdt
  real(dp), intent(in) :: rdisp(ndir), drdisp(ndir), temp(2), dtemp(2), predef(2, npred), &
    dpred(2, npred), time(2), dtime, freqr, props(nprops), coords(mcrd), alocaldir(3, 3), &
    drot(2, 2), area, chrlngth
  character(80), intent(in) :: ciname, secname, mainname
  real(dp) :: p_max, h_0, sigma_c0, K_c, H_c, f_c, slip_rate, u_c, sigma_c, pressure, slope

  p_max = props(1)
  h_0 = props(2)
  sigma_c0 = props(3)
  K_c = props(4)
  H_c = props(5)
  f_c = props(6)
  slip_rate = props(7)
  u_c = statev(1) ! wear at the start of the increment
  sigma_c = sigma_c0 + statev(2) ! state variables start from zero

  ! rdisp(1) is positive where the surfaces overlap, very large and negative far apart
  call contact_pressure(h_0 + u_c - rdisp(1), sigma_c, p_max, pressure, slope)
  stress = 0
  ddsddr = 0
  stress(1) = pressure ! positive in compression
  ddsddr(1, 1) = -slope ! the closure falls by what rdisp(1) grows

  call wear_increment(pressure, slip_rate, dtime, K_c, H_c, f_c, u_c, sigma_c)
  statev(1) = u_c
  statev(2) = sigma_c - sigma_c0
end subroutine uinter
