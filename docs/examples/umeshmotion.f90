! UMESHMOTION for Abaqus/Standard: wear moves the nodes of a surface inwards. Abaqus computes
! pressure and contact; of the model this takes Archard's law. Put the generated file before it:
!
!   derive code rigid_bearing --target fortran -o wear_model.f90
!   cat wear_model.f90 umeshmotion.f90 > user.f90
!
! *ADAPTIVE MESH CONSTRAINT, USER, TYPE=VELOCITY
!   surface nodes, , , jump
!
! jump: the cycles that each cycle of the step stands for, 1 for no cycle jump.
subroutine umeshmotion(uref, ulocal, node, nndof, lnodetype, alocal, ndim, time, dtime, pnewdt, &
    kstep, kinc, kmeshsweep, jmatyp, jgvblock, lsmooth)
  use, intrinsic :: iso_fortran_env, only: dp => real64
  implicit none
  integer, intent(in) :: node, nndof, lnodetype, ndim, kstep, kinc, kmeshsweep, jmatyp(*), &
    jgvblock(*)
  integer, intent(inout) :: lsmooth
  real(dp), intent(in) :: uref, alocal(ndim, *), time(2), dtime
  real(dp), intent(inout) :: ulocal(ndim), pnewdt
  ! Section 4 of the note, in mm, s and MPa: put your own data here.
  real(dp), parameter :: K_c = 1.0e-6_dp, H_c = 200, f_c = 0.25_dp, slip_rate = 4607.669_dp
  integer, parameter :: most = 100
  integer :: elements(most), kinds(most), number, status
  real(dp) :: values(15), u_c, sigma_c

  number = most
  call getnodetoelemconn(node, number, elements, kinds, status, jgvblock)
  call getvrmavgatnode(node, 0, 'CSTRESS', values, status, elements, number, jmatyp, jgvblock)
  if (status /= 0 .or. dtime <= 0) return ! no contact at this node, or no time has passed

  u_c = 0
  sigma_c = 0
  call wear_increment(values(1), slip_rate, uref * dtime, K_c, H_c, f_c, u_c, sigma_c)
  ulocal(ndim) = ulocal(ndim) - u_c / dtime ! the last local direction is the outward normal
end subroutine umeshmotion
